// `real` as LANES scalars side by side, an element each: an item that many elements. So kernels of long formulas keep a
// processor's vector unit at work, whatever its compiler makes of them.
typedef lanes real;
typedef lane_mask mask;
