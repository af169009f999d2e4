// The closest_normal step. One item one unit vector.

#define LEAF 8    // Nodes of so few normals are compared one by one.
#define DEPTH 32  // Of the tree, and more.

/// Where points on the unit sphere are farther than what is found by more than rounding.
#define MARGIN (sizeof(host_scalar) == sizeof(float) ? (host_scalar)1e-5 : (host_scalar)1e-13)

typedef struct {
  host_scalar cosine;
  int number;
} Found;

/// Of two equally near the first.
static inline Found nearer(Found found, host_scalar cosine, int number) {
  const int better = cosine > found.cosine || (cosine == found.cosine && number < found.number);
  found.cosine = better ? cosine : found.cosine;
  found.number = better ? number : found.number;
  return found;
}

/// A k-d tree of `size` normals. A node is a range of places: in its middle the normal that splits it by its entry of
/// `axes`, to both sides its children. `numbers` tells whose normal lies in a place.
kernel void find_closest(const int count, const int size, global const int* axes, global const int* numbers,
                         global const host_scalar* normals, global const host_scalar* units, global int* closest) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const host_scalar unit[3] = {units[3 * i], units[3 * i + 1], units[3 * i + 2]};
  Found found;
  found.cosine = -2;
  found.number = 0;
  int firsts[DEPTH], ends[DEPTH], waiting = 1;
  host_scalar planes[DEPTH];  // How far, squared, all of the node is at least.
  firsts[0] = 0;
  ends[0] = unit[0] == 0 && unit[1] == 0 && unit[2] == 0 ? 0 : size;
  planes[0] = 0;
  while (waiting > 0) {
    --waiting;
    int first = firsts[waiting], end = ends[waiting];
    if (planes[waiting] > 2 - 2 * found.cosine + MARGIN) continue;
    while (end - first > LEAF) {
      const int middle = (first + end) / 2, axis = axes[middle];
      global const host_scalar* n = normals + 3 * middle;
      found = nearer(found, n[0] * unit[0] + n[1] * unit[1] + n[2] * unit[2], numbers[middle]);
      const host_scalar beyond = unit[axis] - n[axis];
      const int low = beyond < 0;
      firsts[waiting] = low ? middle + 1 : first;
      ends[waiting] = low ? end : middle;
      planes[waiting++] = beyond * beyond;
      first = low ? first : middle + 1;
      end = low ? middle : end;
    }
    for (int k = first; k < end; ++k) {
      global const host_scalar* n = normals + 3 * k;
      found = nearer(found, n[0] * unit[0] + n[1] * unit[1] + n[2] * unit[2], numbers[k]);
    }
  }
  closest[i] = found.number;
}
