// What rotation and similarity fit, generated: elements of meshes, and how the meshes are moved.
#pragma once

#include <string>
#include <vector>

#include "swage/mesh.h"
#include "swage/steps.h"

namespace swage::test {

/// An element a vertex with the edges that leave it, a triangle with its sides, or a tetrahedron, from a triangle to
/// the vertices' mean, with its six. Weights of 1.
PairsRest vertex_pairs(const Mesh& mesh);
PairsRest triangle_pairs(const Mesh& mesh);
PairsRest tetrahedron_pairs(const Mesh& mesh);
/// With normals of random directions and weights.
PairsRest with_normals(PairsRest rest, unsigned seed = 5);
/// A third of the weights negative.
PairsRest with_negative_weights(PairsRest rest);

Positions unit_vectors(Eigen::Index count, unsigned seed);

struct PairsCase {
  std::string name;
  PairsRest rest;
  Positions positions, targets;
};

/// Closed, with boundary, flat, needles, tetrahedra, random, one element, empty elements, none, tiny, huge, far away,
/// straight, mirrored, with normals, with negative weights.
std::vector<PairsCase> pairs_cases();

Eigen::Matrix3d matrix(const Transforms& transforms, Eigen::Index row);
/// sum_p w_p b_p a_pᵀ, with the normal where there is one.
Eigen::Matrix3d covariance(const PairsCase& of, Eigen::Index element, bool normals = true);
/// sum_p |w_p| |b_p| |a_p| + |w_n|: what a loss of the trace is measured by.
double covariance_size(const PairsCase& of, Eigen::Index element);

/// Of each vertex its triangles.
NormalFitStep::Rest triangles_around(const Mesh& mesh);

}  // namespace swage::test
