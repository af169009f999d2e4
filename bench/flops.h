// What a step computes, counted by running the kernels' own maths on numbers that count.
#pragma once

namespace swage::bench {

struct Flops {
  int sums = 0, products = 0, quotients = 0, roots = 0;  // Comparisons and choices are not in them.
  int all() const { return sums + products + quotients + roots; }
};

/// Of one element.
Flops flops_of_closest_rotation();
Flops flops_of_rotation(int pairs);
Flops flops_of_similarity(int pairs);
/// Of a triangle, with its share of edges.
Flops flops_of_transform();
Flops flops_of_coupling();
/// In scalars of so many bytes.
Flops flops_of_curvature(int neighbours, double scalar_size);

}  // namespace swage::bench
