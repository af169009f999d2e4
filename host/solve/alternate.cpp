#include "swage/report.h"
namespace swage {}
