// Terms of the transform step's matrix (reshape paper, eq. 35), in C99 ∩ C++, after rows.h.

/// Of a triangle alone: `vectors` sums e e' / L over its edges and the normal regularizer's n n', `directions` d d'.
static inline Rows own_product(Rows transform, Rows vectors, Rows directions, Row normal, real normal_weight,
                               real regularizer_weight) {
  const Row tilts = row_times(row_times(normal, transform), directions);
  const Rows along = add_rows(rows_times(transform, vectors), scale_rows(regularizer_weight, transform));
  return add_rows(along, outer_rows(normal_weight * normal, tilts));
}

/// Of what two neighbours do differently to the directions in `share`.
static inline Rows shared_product(Rows transform, Rows neighbour, Rows share) {
  return rows_times(sub_rows(transform, neighbour), share);
}
