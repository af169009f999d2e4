// What the library and its helper programs say to each other: a mark, then arrays, each a count and its items, as this
// machine has them in memory.
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace swage::wire {

/// A message that is cut short, has too much, or is none.
struct Malformed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline constexpr std::string_view kMark = "swage 1\n";  // Another number for another order of arrays.

class Writer {
 public:
  template <typename Item>
  Writer& add(const Item* items, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<Item>);
    const auto told = static_cast<std::int64_t>(count);
    text_.append(reinterpret_cast<const char*>(&told), sizeof told);
    text_.append(reinterpret_cast<const char*>(items), count * sizeof(Item));
    return *this;
  }
  template <typename Item>
  Writer& add(const std::vector<Item>& items) {
    return add(items.data(), items.size());
  }

  std::string take() { return std::move(text_); }

 private:
  std::string text_{kMark};
};

/// Borrows the message. All throw Malformed.
class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {
    if (!text.starts_with(kMark)) throw Malformed("no message of this version of Swage");
    rest_.remove_prefix(kMark.size());
  }

  /// Of `width` items a row.
  template <typename Item>
  std::vector<Item> read(std::size_t width = 1) {
    static_assert(std::is_trivially_copyable_v<Item>);
    std::int64_t told = 0;
    copy(&told, sizeof told);
    if (told < 0 || static_cast<std::uint64_t>(told) > rest_.size() / sizeof(Item)) cut_short();
    const auto count = static_cast<std::size_t>(told);
    if (count % width != 0) throw Malformed("a message with half a row");
    std::vector<Item> items(count);
    copy(items.data(), count * sizeof(Item));
    return items;
  }

  void finish() const {
    if (!rest_.empty()) throw Malformed("a message that is too long");
  }

 private:
  [[noreturn]] static void cut_short() { throw Malformed("a message that is cut short"); }

  void copy(void* to, std::size_t bytes) {
    if (bytes > rest_.size()) cut_short();
    if (bytes > 0) std::memcpy(to, rest_.data(), bytes);
    rest_.remove_prefix(bytes);
  }

  std::string_view rest_;
};

}  // namespace swage::wire
