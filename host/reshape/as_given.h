// Options and results of a reshaping between the mesh as a caller gives it and the surface that is solved.
#pragma once

#include "given.h"
#include "swage/reshape.h"

namespace swage {

ReshapeOptions into(const Given& given, ReshapeOptions options);
/// What a solve reads of its start.
ReshapeResult into(const Given& given, const ReshapeResult& start);
ReshapeResult back(const Given& given, const ReshapeResult& solved);

}  // namespace swage
