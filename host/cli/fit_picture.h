// How far a fitted template is off its mesh, and how that looks.
#pragma once

#include <string>

#include "picture.h"
#include "swage/compare.h"
#include "swage/template_fit.h"

namespace swage::cli {

struct FitMiss {
  Eigen::VectorXd off;  ///< #T: |f| / |grad f| at the middles of triangles, as a part of the mesh's diagonal.
  Spread angle;         ///< Between the lines of triangles' normals and of grad f there, radians, over the area.
};

FitMiss miss_of(const Template& of, const TemplateFit& fit, const Mesh& mesh, const Backend& backend);

struct ShownFit {
  const std::string& path;  ///< The mesh's.
  const Mesh& mesh;
  const Template& of;
  const TemplateFit& fit;
  const FitMiss& miss;
  const Mesh& surface;  ///< In the mesh's place.
};

/// The mesh, the surface, and both in one place with the mesh coloured by how far it is off. Throws Interrupted.
Image picture_of_fit(const PictureOptions& options, const ShownFit& shown, const CommonOptions& common);

}  // namespace swage::cli
