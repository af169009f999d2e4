// Walks through a text file, word by word.
#pragma once

#include <Eigen/Core>
#include <string_view>

#include "input.h"
#include "number.h"

namespace swage {

/// The largest magnitude of a coordinate: that of check() in mesh.h.
constexpr double kLargestCoordinate = 1e12;

/// Refuses a coordinate that is not finite or too large.
void require_coordinate(const Input& input, size_t offset, double value);

class Scanner {
 public:
  explicit Scanner(const Input& input, size_t begin = 0) : input_(input), text_(input.bytes), at_(begin) {}

  size_t at() const { return at_; }
  size_t remaining() const { return text_.size() - at_; }
  bool at_end() const { return at_ == text_.size(); }
  void jump(size_t offset) { at_ = offset; }

  /// Blanks of this line; a backslash at its end joins the next line to it.
  void skip_blanks();
  /// Blanks and line ends.
  void skip_space();
  /// And comments, from # to the end of a line.
  void skip_space_and_comments();
  /// To the beginning of the next line.
  void skip_line();
  /// Whether nothing but a comment is left of this line.
  bool at_line_end();
  /// What is left of this line, without blanks around it.
  std::string_view rest_of_line();

  /// Up to the next white space.
  std::string_view word();
  /// Takes the character where it comes next.
  bool take(char c);
  bool at_integer() const;

  /// Refuse what is no number or integer, or runs into other characters. `what` is told to be expected.
  double number(Slot& slot, const char* what);
  long long integer(const char* what);
  /// An integer that other characters may follow.
  long long leading_integer(const char* what);

  /// Three numbers of this line.
  Eigen::Vector3d coordinates(Slots& slots);
  Eigen::Vector3d normal(Slots& slots);

 private:
  [[noreturn]] void refuse_word(const char* what);
  void require_delimiter(size_t begin, const char* what);

  const Input& input_;
  std::string_view text_;
  size_t at_;
};

}  // namespace swage
