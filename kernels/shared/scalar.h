// `real` as one scalar: an item an element.
typedef scalar real;
typedef int mask;

static inline int any_lane(mask condition) { return condition; }
