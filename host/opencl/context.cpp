#include "context.h"

#include <chrono>

#include "kernel_source.h"
#include "swage/error.h"
#include "words.h"

namespace swage {
namespace {

/// PoCL's first contexts fail when several threads make them at once.
cl::Context make_context(const cl::Device& device) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  return ask("OpenCL context", [&] { return cl::Context(device); });
}

bool computes_in_vectors(const cl::Device& device) { return device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>() > 1; }

/// Such a device needs no copies of the host's doubles.
bool computes_in_host_memory(const cl::Device& device) {
  return device.getInfo<CL_DEVICE_HOST_UNIFIED_MEMORY>() && device.getInfo<CL_DEVICE_DOUBLE_FP_CONFIG>() != 0;
}

std::string options_for(const cl::Device& device) {
  // Without warnings: PoCL counts those of its own headers on stderr, at each build.
  std::string options = "-cl-std=CL1.2 -w";
  const auto abilities = device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>();
  if (abilities & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) options += " -cl-fp32-correctly-rounded-divide-sqrt";
  // Oclgrind runs no inlined function that gives a struct (it stops at llvm.experimental.noalias.scope.decl).
  const cl::Platform platform(device.getInfo<CL_DEVICE_PLATFORM>());
  if (platform.getInfo<CL_PLATFORM_NAME>() == "Oclgrind") options += " -cl-opt-disable -DALWAYS_INLINE=";
  return options;
}

std::string key_of(const cl::Device& device, const std::string& options, const std::string& source) {
  const cl::Platform platform(device.getInfo<CL_DEVICE_PLATFORM>());
  return device.getInfo<CL_DEVICE_NAME>() + '\n' + device.getInfo<CL_DEVICE_VERSION>() + '\n' +
         device.getInfo<CL_DRIVER_VERSION>() + '\n' + platform.getInfo<CL_PLATFORM_VERSION>() + '\n' + options + '\n' +
         source;
}

std::string words_of(const cl::BuildError& error) {
  std::string words;
  for (const auto& [device, log] : error.getBuildLog()) words += log;
  return words;
}

/// Tried anew where it fails: PoCL may, with no word of the source, while another process builds into the same folder.
cl::Program compiled(const cl::Context& context, const cl::Device& device, const std::string& name,
                     const std::string& source, const std::string& options) {
  constexpr int kTries = 3;
  for (int tried = 1;; ++tried) {
    cl::Program program(context, source);
    try {
      program.build(device, options.c_str());
      return program;
    } catch (const cl::BuildError& error) {
      if (tried < kTries) continue;
      throw Unavailable("kernels/" + name +
                        ": the device's compiler refuses it: take another device or the cpu backend\n" +
                        words_of(error));
    }
  }
}

}  // namespace

Context::Context(const cl::Device& device, Precision precision, ProgramCache cache)
    : Context(device, precision, std::move(cache), computes_in_host_memory(device)) {}

Context::Context(const cl::Device& device, Precision precision, ProgramCache cache, bool in_host_memory)
    : device_(device),
      precision_(precision),
      in_vectors_(computes_in_vectors(device)),
      in_host_memory_(in_host_memory),
      handle_(make_context(device)),
      cache_(std::move(cache)),
      options_(options_for(device)),
      memory_(device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>()) {}

int Context::lanes(const std::string& stem) const { return in_vectors_ ? lanes_of(stem) : 1; }

Arithmetic Context::arithmetic(const std::string& stem) const { return {precision_, lanes(stem), in_host_memory_}; }

cl::Program Context::program(const std::string& stem) {
  return build(stem + ".cl", program_source(stem, arithmetic(stem)));
}

cl::Program Context::program_alone(const std::string& stem) {
  return build(stem + ".cl", program_source(stem, {precision_, 1, in_host_memory_}));
}

cl::Program Context::program(const std::string& name, const std::string& text) {
  return build(name, program_source(name, text, arithmetic(name)));
}

cl::Program Context::build(const std::string& name, const std::string& source) {
  std::promise<cl::Program> mine;
  std::shared_future<cl::Program> program;
  {
    const std::lock_guard lock(mutex_);
    std::shared_future<cl::Program>& known = programs_[source];
    if (known.valid()) {
      program = known;
    } else {
      known = mine.get_future().share();
    }
  }
  if (program.valid()) return program.get();
  const auto start = std::chrono::steady_clock::now();
  try {
    mine.set_value(compile(name, source));
  } catch (...) {
    mine.set_exception(std::current_exception());
  }
  build_nanoseconds_ += (std::chrono::steady_clock::now() - start) / std::chrono::nanoseconds(1);
  const std::lock_guard lock(mutex_);
  return programs_[source].get();
}

cl::Program Context::compile(const std::string& name, const std::string& source) const {
  return ask("kernels/" + name, [&] {
    const std::string key = key_of(device_, options_, source);
    if (const auto kept = cache_.find(key)) {
      try {
        cl::Program program(handle_, {device_}, {*kept});
        program.build(device_, options_.c_str());
        return program;
      } catch (const cl::Error&) {
        // Kept by a driver that calls itself the same and is not: built again.
      }
    }
    cl::Program program = compiled(handle_, device_, name, source, options_);
    keep(key, program);
    return program;
  });
}

void Context::keep(const std::string& key, const cl::Program& program) const {
  if (!cache_.keeps()) return;
  try {
    cache_.keep(key, program.getInfo<CL_PROGRAM_BINARIES>().front());
  } catch (const cl::Error&) {
    // A driver that gives no binary: the program is as good.
  }
}

std::shared_ptr<const std::size_t> Context::claim(std::size_t bytes) {
  const std::size_t claimed = claimed_ += bytes;
  if (claimed > memory_) {
    claimed_ -= bytes;
    throw Unavailable("device array of " + std::to_string(bytes) + " bytes: of the device's " +
                      std::to_string(memory_) + ", " + std::to_string(claimed - bytes) +
                      " are in use: take a smaller mesh, another device or the cpu backend");
  }
  return {new std::size_t(bytes), [this](const std::size_t* claim) {
            claimed_ -= *claim;
            delete claim;
          }};
}

Traffic Context::traffic() const { return {uploaded_, downloaded_, static_cast<double>(build_nanoseconds_) * 1e-9}; }

Queue::Queue(std::shared_ptr<Context> of)
    : context(std::move(of)),
      handle(ask("OpenCL queue", [&] { return cl::CommandQueue(context->handle(), context->device()); })) {}

}  // namespace swage
