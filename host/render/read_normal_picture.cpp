// PNG files whose colours are directions.
#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include "input.h"
#include "number.h"
#include "swage/style_io.h"

#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>

namespace swage {
namespace {

constexpr unsigned long long kMostPixels = 1ULL << 26;
constexpr size_t kSignature = 8, kHeader = 33;  // Bytes, the width at 16, the height at 20.

struct Free {
  void operator()(void* pixels) const { stbi_image_free(pixels); }
};

/// -1 to 1. The two values in the middle are both 0: none is there.
template <typename Channel>
float coordinate(Channel value) {
  constexpr int kFull = std::numeric_limits<Channel>::max();
  const int twice = 2 * value - kFull;
  return std::abs(twice) == 1 ? 0.0f : static_cast<float>(twice) / static_cast<float>(kFull);
}

template <typename Channel>
void convert(const Channel* pixels, NormalPicture& picture) {
  constexpr int kFull = std::numeric_limits<Channel>::max();
  const size_t count = static_cast<size_t>(picture.width) * static_cast<size_t>(picture.height);
  picture.normals.assign(3 * count, 0);
  for (size_t i = 0; i < count; ++i) {
    const Channel* pixel = pixels + 4 * i;
    const Eigen::Vector3f normal(coordinate(pixel[0]), coordinate(pixel[1]), coordinate(pixel[2]));
    const float length = normal.norm();
    if (2 * pixel[3] < kFull || length < 0.5f || length > 1.5f) continue;
    Eigen::Map<Eigen::Vector3f>(&picture.normals[3 * i]) = normal;
  }
}

[[noreturn]] void refuse_damaged(const Input& input, const std::string& why) {
  refuse(input, "is a damaged PNG file (" + why + "); export it again");
}

/// What the decoder is given. It takes the memory that chunks say they need, and the size from wherever a header
/// stands; chunks of no pixels, which may be there and are left out, it would copy from none to nowhere.
std::string checked_chunks(const Input& input) {
  const std::string& bytes = input.bytes;
  if (bytes.size() < kHeader || bytes.compare(12, 4, "IHDR") != 0) {
    refuse_damaged(input, "it does not begin with a header");
  }
  constexpr size_t kBefore = 8, kAfter = 4;  // Of a chunk: its length and kind, and a sum.
  std::string chunks = bytes.substr(0, kSignature);
  for (size_t at = kSignature, length = 0; true; at += kBefore + length + kAfter) {
    if (at + kBefore > bytes.size()) refuse_damaged(input, "it has no end");
    length = load<std::uint32_t>(&bytes[at], true);
    if (length > bytes.size() - at - kBefore) refuse_damaged(input, "it ends within a chunk");
    const std::string kind = bytes.substr(at + 4, 4);
    if (kind != "IDAT" || length > 0) chunks.append(bytes, at, kBefore + length + kAfter);
    if (kind == "IEND") return chunks;
  }
}

}  // namespace

NormalPicture read_normal_picture(const std::filesystem::path& path) {
  const Input input = slurp(path);
  if (!input.bytes.starts_with("\x89PNG\r\n\x1A\n")) refuse(input, "is no PNG file; convert the picture to one");
  if (input.bytes.size() > static_cast<size_t>(std::numeric_limits<int>::max())) {
    refuse(input, "has more than 2^31 bytes; make the picture smaller");
  }
  const std::string chunks = checked_chunks(input);
  const auto* bytes = reinterpret_cast<const stbi_uc*>(chunks.data());
  const int size = static_cast<int>(chunks.size());
  const auto width = load<std::uint32_t>(&chunks[16], true), height = load<std::uint32_t>(&chunks[20], true);
  if (1ULL * width * height > kMostPixels) {
    refuse(input, "has " + std::to_string(width) + " x " + std::to_string(height) +
                      " pixels; make it smaller, of 2^26 at most, such as 8192 x 8192");
  }
  NormalPicture picture;
  int channels = 0;
  const auto read = [&](auto decode) {
    const auto pixels = decode(bytes, size, &picture.width, &picture.height, &channels, STBI_rgb_alpha);
    if (!pixels) {
      const char* reason = stbi_failure_reason();
      refuse_damaged(input, reason == nullptr ? "unknown" : reason);
    }
    if (channels < 3) refuse(input, "is a grey picture; normals need red, green and blue: export it in colours");
    convert(pixels.get(), picture);
  };
  if (stbi_is_16_bit_from_memory(bytes, size) != 0) {
    read([](auto... all) { return std::unique_ptr<stbi_us, Free>(stbi_load_16_from_memory(all...)); });
  } else {
    read([](auto... all) { return std::unique_ptr<stbi_uc, Free>(stbi_load_from_memory(all...)); });
  }
  return picture;
}

}  // namespace swage
