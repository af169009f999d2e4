#include "failure.h"

#include <spdlog/spdlog.h>

#include <CLI/Error.hpp>
#include <new>
#include <stdexcept>
#include <string>

#include "interrupt.h"
#include "swage/error.h"

namespace swage::cli {
namespace {

int fail(ExitCode code, std::string message) {
  for (char& c : message) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  spdlog::error("{}", message);
  return code;
}

int explain_any() {
  try {
    throw;
  } catch (const WrongUsage& e) {
    return fail(exit_wrong_usage, e.what());
  } catch (const CLI::ParseError& e) {
    return fail(exit_wrong_usage, std::string(e.what()) + " (swage --help lists what there is)");
  } catch (const InvalidInput& e) {
    return fail(exit_refused, e.what());
  } catch (const UnreadableFile& e) {
    return fail(exit_refused, e.what());
  } catch (const std::bad_alloc&) {
    return fail(exit_failed, kOutOfMemory);
  } catch (const std::length_error&) {  // More than any memory holds.
    return fail(exit_failed, kOutOfMemory);
  } catch (const std::exception& e) {
    return fail(exit_failed, e.what());
  } catch (...) {
    return fail(exit_failed, "an unknown error");
  }
}

}  // namespace

int explain_failure() {
  // A cancelled call may end in any exception: what counts is that the user asked for it.
  if (interrupted()) return fail(exit_interrupted, "interrupted: files not yet written are as they were");
  return explain_any();
}

}  // namespace swage::cli
