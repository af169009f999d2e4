// STL files.
#include "fuzz.h"
#include "mesh_file.h"

void swage::fuzz::use(std::string_view bytes) { use_mesh(".stl", bytes); }
