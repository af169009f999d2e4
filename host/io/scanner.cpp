#include "scanner.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swage {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

void require_coordinate(const Input& input, size_t offset, double value) {
  if (std::abs(value) <= kLargestCoordinate) return;
  refuse(input, offset,
         std::isfinite(value) ? "a coordinate is beyond 1e12 in magnitude; rescale the mesh or mend the vertex"
                              : "a coordinate is not a finite number; mend or remove the vertex");
}

void Scanner::skip_blanks() {
  while (!at_end()) {
    const char c = text_[at_];
    if (c == '\\') {
      const size_t end = at_ + 1 + (text_.substr(at_ + 1).starts_with("\r\n") ? 1 : 0);
      if (end >= text_.size() || text_[end] != input_.newline) return;
      at_ = end;
    } else if (c == input_.newline || !is_space(c)) {
      return;
    }
    ++at_;
  }
}

void Scanner::skip_space() {
  while (!at_end() && is_space(text_[at_])) ++at_;
}

void Scanner::skip_space_and_comments() {
  skip_space();
  while (!at_end() && text_[at_] == '#') {
    skip_line();
    skip_space();
  }
}

void Scanner::skip_line() {
  const size_t end = text_.find(input_.newline, at_);
  at_ = end == std::string_view::npos ? text_.size() : end + 1;
}

bool Scanner::at_line_end() {
  skip_blanks();
  return at_end() || text_[at_] == input_.newline || text_[at_] == '#';
}

std::string_view Scanner::rest_of_line() {
  skip_blanks();
  const size_t begin = at_;
  at_ = std::min(text_.find(input_.newline, at_), text_.size());
  size_t end = at_;
  while (end > begin && is_space(text_[end - 1])) --end;
  return text_.substr(begin, end - begin);
}

std::string_view Scanner::word() {
  const size_t begin = at_;
  while (!at_end() && !is_space(text_[at_])) ++at_;
  return text_.substr(begin, at_ - begin);
}

bool Scanner::take(char c) {
  if (at_end() || text_[at_] != c) return false;
  ++at_;
  return true;
}

bool Scanner::at_integer() const {
  return !at_end() && (is_digit(text_[at_]) || text_[at_] == '-' || text_[at_] == '+');
}

double Scanner::number(Slot& slot, const char* what) {
  double value = 0;
  const size_t length = parse_number(text_.substr(at_), value);
  if (length == 0 || length > std::numeric_limits<std::uint32_t>::max()) refuse_word(what);
  slot = {at_, static_cast<std::uint32_t>(length), NumberKind::text};
  at_ += length;
  require_delimiter(slot.offset, what);
  return value;
}

long long Scanner::leading_integer(const char* what) {
  long long value = 0;
  const size_t length = parse_integer(text_.substr(at_), value);
  if (length == 0) refuse_word(what);
  at_ += length;
  return value;
}

long long Scanner::integer(const char* what) {
  const size_t begin = at_;
  const long long value = leading_integer(what);
  require_delimiter(begin, what);
  return value;
}

Eigen::Vector3d Scanner::coordinates(Slots& slots) {
  Eigen::Vector3d point;
  for (int k = 0; k < 3; ++k) {
    skip_blanks();
    Slot& slot = slots[static_cast<size_t>(k)];
    point[k] = number(slot, "a coordinate (a vertex needs three)");
    require_coordinate(input_, slot.offset, point[k]);
  }
  return point;
}

Eigen::Vector3d Scanner::normal(Slots& slots) {
  Eigen::Vector3d direction;
  for (int k = 0; k < 3; ++k) {
    skip_blanks();
    direction[k] = number(slots[static_cast<size_t>(k)], "a number of a normal (it needs three)");
  }
  return direction;
}

void Scanner::refuse_word(const char* what) {
  const std::string expected = std::string(what) + " is expected";
  if (at_end()) refuse(input_, at_, "the file ends where " + expected + "; it is truncated: export it again");
  const size_t begin = at_;
  const std::string_view found = word();
  refuse(input_, begin,
         expected + (found.empty() ? ", but the line ends" : ", not " + in_quotes(found)) +
             "; mend the line or export the mesh again");
}

void Scanner::require_delimiter(size_t begin, const char* what) {
  if (at_end()) return;
  const char c = text_[at_];
  if (is_space(c) || c == '#' || c == '\\') return;
  at_ = begin;
  refuse_word(what);
}

}  // namespace swage
