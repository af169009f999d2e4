#include "free_form.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numeric>
#include <utility>

namespace swage {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kCells = 4;              // Along the longest side; along others in proportion to the root of theirs.
constexpr size_t kMostSeen = 10000;    // About, of vertices: far more than there are control points.
constexpr double kThin = 1e-6;         // Of the longest side: a box is no thinner.
constexpr double kBending = 4e-5;      // What squared second differences count, against squares of what is asked for,
constexpr double kFineBending = 1e-3;  // those of the finer ones,
constexpr double kStill = 3e-4;   // and first differences: what little is told of turning the nearly round is noise,
constexpr double kLeast = 3e-10;  // and any: nothing tells of some at all.

/// The three quadratic B-splines that are not zero within a cell, and their slopes.
Vector3d spline(double u) { return {0.5 * (1 - u) * (1 - u), 0.5 + u * (1 - u), 0.5 * u * u}; }
Vector3d spline_slope(double u) { return {u - 1, 1 - 2 * u, u}; }

}  // namespace

FreeForm::FreeForm(const Positions& rest) {
  const Eigen::Array3d low = rest.colwise().minCoeff().transpose();
  const Eigen::Array3d sides = rest.colwise().maxCoeff().transpose().array() - low;
  const Eigen::Array3d thick = sides.max(kThin * sides.maxCoeff());
  cells_ = (kCells * (thick / thick.maxCoeff()).sqrt()).round().cast<int>().max(1);
  widths_ = thick / cells_.cast<double>();
  inside_.resize(static_cast<size_t>(cells_.prod()));
  for (const auto& x : rest.rowwise()) {
    const Eigen::Array3d at = (x.transpose().array() - low) / widths_;
    const Eigen::Array3i place = at.cast<int>().min(cells_ - 1);
    const int cell = (place[0] * cells_[1] + place[1]) * cells_[2] + place[2];
    inside_[static_cast<size_t>(cell)].push_back(static_cast<int>(sites_.size()));
    sites_.push_back({cell, at - place.cast<double>()});
  }
  seen_ = some();
  bending_ = bending();
}

/// Evenly of each cell, in an order that is of where they are, not of how the mesh lists them.
std::vector<std::vector<int>> FreeForm::some() const {
  const size_t every = 1 + sites_.size() / kMostSeen;
  if (every == 1) return inside_;
  std::vector<std::vector<int>> some(inside_.size());
  for (size_t cell = 0; cell < inside_.size(); ++cell) {
    std::vector<int> ordered = inside_[cell];
    std::sort(ordered.begin(), ordered.end(), [&](int a, int b) {
      const Eigen::Vector3d &x = sites_[static_cast<size_t>(a)].at, &y = sites_[static_cast<size_t>(b)].at;
      return std::lexicographical_compare(x.begin(), x.end(), y.begin(), y.end());
    });
    for (size_t i = every / 2; i < ordered.size(); i += every) some[cell].push_back(ordered[i]);
  }
  return some;
}

/// First those of the grid, then those of x, y and z alone.
std::array<int, FreeForm::kOfCell> FreeForm::control_of(int cell) const {
  const Eigen::Array3i place(cell / cells_[2] / cells_[1], cell / cells_[2] % cells_[1], cell % cells_[2]);
  std::array<int, kOfCell> control{};
  size_t next = 0;
  for (int i = 0; i < 27; ++i) {
    control[next++] =
        ((place[0] + i / 9) * (cells_[1] + 2) + place[1] + i / 3 % 3) * (cells_[2] + 2) + place[2] + i % 3;
  }
  int first = (cells_ + 2).prod();
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < kFiner + 2; ++i) control[next++] = first + kFiner * place[k] + i;
    first += kFiner * cells_[k] + 2;
  }
  return control;
}

FreeForm::Splines FreeForm::splines(const Site& site) const {
  Splines result;
  Matrix3d values, slopes;
  for (int k = 0; k < 3; ++k) {
    values.col(k) = spline(site.at[k]);
    slopes.col(k) = spline_slope(site.at[k]) / widths_[k];
  }
  for (int i = 0; i < 27; ++i) {
    const int x = i / 9, y = i / 3 % 3, z = i % 3;
    result.of[static_cast<size_t>(i)] = i;
    result.values[i] = values(x, 0) * values(y, 1) * values(z, 2);
    result.gradients.row(i) << slopes(x, 0) * values(y, 1) * values(z, 2), values(x, 0) * slopes(y, 1) * values(z, 2),
        values(x, 0) * values(y, 1) * slopes(z, 2);
  }
  for (int k = 0; k < 3; ++k) {
    const int place = std::min(static_cast<int>(kFiner * site.at[k]), kFiner - 1);
    const double u = kFiner * site.at[k] - place;
    const int i = 27 + 3 * k;
    const auto first = result.of.begin() + i;
    std::iota(first, first + 3, 27 + (kFiner + 2) * k + place);
    result.values.segment<3>(i) = spline(u);
    result.gradients.middleRows<3>(i).setZero();
    result.gradients.col(k).segment<3>(i) = kFiner / widths_[k] * spline_slope(u);
  }
  return result;
}

/// The squares of second differences, as of a thin plate, and a little of the first.
MatrixXd FreeForm::bending() const {
  const Eigen::Array3i count = cells_ + 2, fine = kFiner * cells_ + 2;
  const Eigen::Array3i stride(count[1] * count[2], count[2], 1);
  MatrixXd sum = kLeast * MatrixXd::Identity(count.prod() + fine.sum(), count.prod() + fine.sum());
  const auto add = [&](double weight, std::initializer_list<std::pair<int, double>> difference) {
    for (const auto& [i, a] : difference) {
      for (const auto& [j, b] : difference) sum(i, j) += weight * a * b;
    }
  };
  for (int at = 0; at < count.prod(); ++at) {
    const Eigen::Array3i left = count - Eigen::Array3i(at / stride[0], at / stride[1] % count[1], at % count[2]);
    for (int k = 0; k < 3; ++k) {
      const int step = stride[k];
      if (left[k] > 1) add(kStill, {{at, -1}, {at + step, 1}});
      if (left[k] > 2) add(kBending, {{at, 1}, {at + step, -2}, {at + 2 * step, 1}});
      for (int m = k + 1; m < 3; ++m) {
        const int aside = stride[m];
        if (left[k] > 1 && left[m] > 1) {
          add(2 * kBending, {{at, 1}, {at + step, -1}, {at + aside, -1}, {at + step + aside, 1}});
        }
      }
    }
  }
  int at = count.prod();
  for (int k = 0; k < 3; ++k) {
    for (int left = fine[k]; left > 0; --left, ++at) {
      if (left > 1) add(kStill, {{at, -1}, {at + 1, 1}});
      if (left > 2) add(kFineBending, {{at, 1}, {at + 1, -2}, {at + 2, 1}});
    }
  }
  return sum;
}

/// Of a cell's control points the lower blocks of the sum over its vertices of (row_v . d(v))².
MatrixXd FreeForm::squares(int cell, const Positions& rows) const {
  MatrixXd sum = MatrixXd::Zero(3 * kOfCell, 3 * kOfCell);
  for (const int v : seen_[static_cast<size_t>(cell)]) {
    const Splines splines = this->splines(sites_[static_cast<size_t>(v)]);
    const Matrix3d square = rows.row(v).transpose() * rows.row(v);
    for (int i = 0; i < kOfSite; ++i) {
      for (int j = 0; j <= i; ++j) {
        sum.block<3, 3>(3 * splines.of[static_cast<size_t>(i)], 3 * splines.of[static_cast<size_t>(j)]) +=
            splines.values[i] * splines.values[j] * square;
      }
    }
  }
  return sum;
}

/// What each control point's displacement is multiplied by in the sum over vertices of d(v) . other_v.
Positions FreeForm::products(const Positions& others) const {
  Positions sums = Positions::Zero(bending_.rows(), 3);
  for (size_t cell = 0; cell < seen_.size(); ++cell) {
    const std::array<int, kOfCell> control = control_of(static_cast<int>(cell));
    for (const int v : seen_[cell]) {
      const Splines splines = this->splines(sites_[static_cast<size_t>(v)]);
      for (int i = 0; i < kOfSite; ++i) {
        const auto of = static_cast<size_t>(splines.of[static_cast<size_t>(i)]);
        sums.row(control[of]) += splines.values[i] * others.row(v);
      }
    }
  }
  return sums;
}

Positions FreeForm::fit(const Positions& directions, const VectorXd& amounts, const VectorXd& weights,
                        const std::vector<Positions>& idle) const {
  double mass = 0;
  for (const std::vector<int>& seen : seen_) mass += weights(seen).sum();
  const VectorXd parts = weights / mass;
  const Positions rows = parts.cwiseSqrt().asDiagonal() * directions;
  std::vector<MatrixXd> told(seen_.size());
#pragma omp parallel for schedule(dynamic)
  for (int cell = 0; cell < static_cast<int>(seen_.size()); ++cell)
    told[static_cast<size_t>(cell)] = squares(cell, rows);
  const Index count = bending_.rows();
  MatrixXd matrix = MatrixXd::Zero(3 * count, 3 * count);  // The lower blocks.
  for (Index j = 0; j < count; ++j) {
    for (Index i = j; i < count; ++i) matrix.block<3, 3>(3 * i, 3 * j).diagonal().setConstant(bending_(i, j));
  }
  for (size_t cell = 0; cell < told.size(); ++cell) {
    const std::array<int, kOfCell> control = control_of(static_cast<int>(cell));
    for (int i = 0; i < kOfCell; ++i) {
      for (int j = 0; j <= i; ++j) {
        matrix.block<3, 3>(3 * control[static_cast<size_t>(i)], 3 * control[static_cast<size_t>(j)]) +=
            told[cell].block<3, 3>(3 * i, 3 * j);
      }
    }
  }
  for (const Positions& motion : idle) {
    const Positions product = products(parts.asDiagonal() * motion);
    matrix.selfadjointView<Eigen::Lower>().rankUpdate(Eigen::Map<const VectorXd>(product.data(), product.size()));
  }
  Positions control = products(parts.cwiseProduct(amounts).asDiagonal() * directions);
  Eigen::Map<VectorXd> flat(control.data(), control.size());
  const Eigen::LLT<Eigen::Ref<MatrixXd>> factored(matrix);
  factored.solveInPlace(flat);
  return control;
}

Positions FreeForm::displacements(const Positions& control) const {
  Positions result(static_cast<Index>(sites_.size()), 3);
#pragma omp parallel for schedule(static)
  for (size_t cell = 0; cell < inside_.size(); ++cell) {
    const Positions own = control(control_of(static_cast<int>(cell)), Eigen::all);
    for (const int v : inside_[cell]) {
      const Splines splines = this->splines(sites_[static_cast<size_t>(v)]);
      result.row(v) = splines.values.transpose() * own(splines.of, Eigen::all);
    }
  }
  return result;
}

Transforms FreeForm::maps(const Positions& control) const {
  Transforms result(static_cast<Index>(sites_.size()), 9);
#pragma omp parallel for schedule(static)
  for (size_t cell = 0; cell < inside_.size(); ++cell) {
    const Positions own = control(control_of(static_cast<int>(cell)), Eigen::all);
    for (const int v : inside_[cell]) {
      const Splines splines = this->splines(sites_[static_cast<size_t>(v)]);
      Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(result.row(v).data()) =
          Matrix3d::Identity() + own(splines.of, Eigen::all).transpose() * splines.gradients;
    }
  }
  return result;
}

}  // namespace swage
