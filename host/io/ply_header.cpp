#include "ply_header.h"

#include <algorithm>
#include <map>
#include <set>

#include "scanner.h"

namespace swage {
namespace {

class HeaderReader {
 public:
  explicit HeaderReader(const Input& input) : input_(input), scan_(input) {}

  PlyHeader read() {
    scan_.skip_line();
    while (statement()) scan_.skip_line();
    scan_.skip_line();
    header_.end = scan_.at();
    if (!has_format_) refuse(input_, 0, "the PLY header has no format line; export the mesh again");
    return std::move(header_);
  }

 private:
  // False at the end of the header.
  bool statement() {
    scan_.skip_blanks();
    if (scan_.at_end())
      refuse(input_, scan_.at(), "the PLY header has no end_header; it is truncated: export it again");
    offset_ = scan_.at();
    const std::string_view keyword = scan_.word();
    if (keyword == "format") {
      format();
    } else if (keyword == "element") {
      element();
    } else if (keyword == "property") {
      property();
    } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info" && keyword != "end_header") {
      refuse(input_, offset_, in_quotes(keyword) + " is no PLY header line; export the mesh again");
    }
    return keyword != "end_header";
  }

  std::string_view next_word() {
    scan_.skip_blanks();
    return scan_.word();
  }

  void format() {
    using Encoding = PlyHeader::Encoding;
    static const std::map<std::string_view, Encoding> kEncodings = {{"ascii", Encoding::ascii},
                                                                    {"binary_little_endian", Encoding::little_endian},
                                                                    {"binary_big_endian", Encoding::big_endian}};
    const std::string_view word = next_word();
    const auto found = kEncodings.find(word);
    if (found == kEncodings.end()) {
      refuse(input_, offset_, in_quotes(word) + " is no PLY format; use ascii or binary_little_endian");
    }
    header_.encoding = found->second;
    has_format_ = true;
  }

  void element() {
    PlyElement element{std::string(next_word()), 0, {}, offset_};
    scan_.skip_blanks();
    element.count = scan_.integer("the number of elements");
    if (!elements_.insert(element.name).second) {
      refuse(input_, offset_, "element " + in_quotes(element.name) + " comes twice; export again");
    }
    properties_.clear();
    header_.elements.push_back(std::move(element));
  }

  void property() {
    if (header_.elements.empty()) refuse(input_, offset_, "a property stands before any element; export again");
    PlyProperty property;
    std::string_view word = next_word();
    if (word == "list") {
      property.is_list = true;
      property.count_type = type(next_word());
      if (!is_integer(property.count_type)) refuse(input_, offset_, "a list's length must be an integer; export again");
      word = next_word();
    }
    property.type = type(word);
    property.name = next_word();
    if (!properties_.insert(property.name).second) {
      refuse(input_, offset_, "property " + in_quotes(property.name) + " comes twice; export again");
    }
    header_.elements.back().properties.push_back(std::move(property));
  }

  PlyType type(std::string_view word) const {
    static const std::map<std::string_view, PlyType> kTypes = {
        {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
        {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
        {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
        {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
        {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
        {"float64", PlyType::float64}};
    const auto found = kTypes.find(word);
    if (found == kTypes.end()) refuse(input_, offset_, in_quotes(word) + " is no PLY type; export the mesh again");
    return found->second;
  }

  const Input& input_;
  Scanner scan_;
  PlyHeader header_;
  size_t offset_ = 0;  // Of the line being read.
  bool has_format_ = false;
  std::set<std::string> elements_, properties_;  // Names, of properties those of the last element.
};

}  // namespace

size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::float64:
      break;
  }
  return 8;
}

bool is_integer(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

PlyHeader read_ply_header(Input& input) {
  const std::string_view bytes = input.bytes;
  const size_t magic_end = std::min(bytes.find_first_of(" \r\n"), bytes.size());
  if (bytes.substr(0, magic_end) != "ply") {
    refuse(input, 0,
           "not a PLY file: it begins with " + in_quotes(bytes.substr(0, magic_end)) + "; check its extension");
  }
  // A binary body may hold the other kind of line end, so the first line decides.
  input.newline =
      bytes.substr(magic_end).starts_with('\r') && !bytes.substr(magic_end).starts_with("\r\n") ? '\r' : '\n';
  return HeaderReader(input).read();
}

}  // namespace swage
