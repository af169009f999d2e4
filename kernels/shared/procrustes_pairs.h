// What rotation and similarity share on the device, in OpenCL C alone. Matrices lie in columns, positions in rows.

/// One item an element: sum_p b_p (w_p a_p)ᵀ. `edges`: w_p a_p. A kernel of its own, for its loop.
kernel void gather_pairs(const int count, global const int* offsets, global const int* pairs, global const real* edges,
                         global const real* positions, global real* sums) {
  const int i = get_global_id(0);
  if (i >= count) return;
  Mat3 sum = mat3(vec3(0, 0, 0), vec3(0, 0, 0), vec3(0, 0, 0));
  for (int p = offsets[i]; p < offsets[i + 1]; ++p) {
    const Vec3 b = sub3(row3(positions, pairs[2 * p + 1]), row3(positions, pairs[2 * p]));
    sum = add_mat3(sum, outer3(b, row3(edges, p)));
  }
  store_column9(sum, sums, count, i);
}

/// One item an element: `sums` and t (w_n n)ᵀ. `normals`: w_n n.
kernel void add_normals(const int count, global const real* sums, global const real* normals,
                        global const real* targets, global real* with_normals) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const Mat3 normal = outer3(column3(targets, count, 0, i), column3(normals, count, 0, i));
  store_column9(add_mat3(column9(sums, count, i), normal), with_normals, count, i);
}

/// One item an element: steps 1 to 3 of the closest rotation. PoCL vectorises these and the last, but not all in one.
kernel void turn_near(const int count, global const real* sums, global real* turns) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const Quaternion q = closest_unreflected(column9(sums, count, i));
  turns[i] = q.w;
  turns[count + i] = q.x;
  turns[2 * count + i] = q.y;
  turns[3 * count + i] = q.z;
}

static inline Mat3 load_rotation(global const real* sums, global const real* turns, int n, int i) {
  return finish_rotation(column9(sums, n, i), quaternion(turns[i], turns[n + i], turns[2 * n + i], turns[3 * n + i]));
}
