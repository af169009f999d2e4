// Tapes compared.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "swage/tape.h"

namespace swage::fuzz {

inline bool same_instructions(const std::vector<TapeInstruction>& one, const std::vector<TapeInstruction>& other) {
  const auto same = [](const TapeInstruction& a, const TapeInstruction& b) {
    return a.op == b.op && a.a == b.a && a.b == b.b;
  };
  return std::equal(one.begin(), one.end(), other.begin(), other.end(), same);
}

/// Constants to the bit: they may be infinite, and no numbers.
inline bool same_tape(const Tape& one, const Tape& other) {
  const auto same = [](double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  };
  return one.parameter_count == other.parameter_count && one.root == other.root &&
         std::equal(one.constants.begin(), one.constants.end(), other.constants.begin(), other.constants.end(), same) &&
         same_instructions(one.setup, other.setup) && same_instructions(one.body, other.body);
}

}  // namespace swage::fuzz
