// `swage reshape --method poisson|arap|arap-volume|conformal`: what reshaping is compared with.
#pragma once

#include <optional>
#include <string>

#include "reshape.h"
#include "swage/deform.h"

namespace swage::cli {

/// None where the name is of a method of reshaping.
std::optional<DeformMethod> deform_method(const std::string& name);

/// Throws WrongUsage for an option that the method has no use for.
void check_deform_job(const ReshapeJob& job);

DeformOptions deform_options(const ReshapeJob& job, DeformMethod method, const ReshapeOptions& options);

/// As a reshaping's.
ReshapeResult as_reshaped(DeformResult result);

}  // namespace swage::cli
