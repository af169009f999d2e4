// Terms of the transform step's matrix (reshape paper, eq. 35), in C99 ∩ C++, after symmetric.h.

/// Of a triangle alone: `vectors` sums e e' / L over its edges, `directions` d d'.
static inline Mat3 own_product(Mat3 transform, Symmetric vectors, Symmetric directions, Vec3 normal, real normal_weight,
                               real regularizer_weight) {
  const Vec3 tilts = apply_symmetric(directions, apply3(transpose3(transform), normal));
  const Mat3 along = add_mat3(times_symmetric(transform, vectors), scale_mat3(regularizer_weight, transform));
  return add_mat3(along, outer3(scale3(normal_weight, normal), tilts));
}

/// Of what two neighbours do differently to the directions in `share`.
static inline Mat3 shared_product(Mat3 transform, Mat3 neighbour, Symmetric share) {
  return times_symmetric(add_mat3(transform, scale_mat3(-1, neighbour)), share);
}
