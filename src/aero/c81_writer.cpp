#include "heerk_rotor/aero/c81_writer.hpp"

#include <cstdio>
#include <stdexcept>
#include <string>

namespace heerk_rotor {
namespace {

constexpr int kPerLine = 9;

/// The number in exactly seven columns, with the most decimals that fit.
std::string field(double value) {
  char text[64];
  for (int decimals = 5; decimals >= 0; --decimals) {
    const int length = std::snprintf(text, sizeof text, "%#.*f", decimals, value);
    std::string number(text);
    // ".1234" and "-.1234" are as good as "0.1234" and save a column
    if (length == 8 && number.compare(0, 2, "0.") == 0) number.erase(0, 1);
    if (length == 8 && number.compare(0, 3, "-0.") == 0) number.erase(1, 1);
    if (number.size() <= 7) return std::string(7 - number.size(), ' ') + number;
  }
  throw std::invalid_argument("writeC81: " + std::to_string(value) + " does not fit in seven columns");
}

void writeNumbers(std::ostream& out, const std::string& first, const double* values, std::size_t count) {
  out << first;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0 && i % kPerLine == 0) out << "\n       ";
    out << field(values[i]);
  }
  out << '\n';
}

void writeBlock(std::ostream& out, const C81Block& block) {
  writeNumbers(out, "       ", block.mach.data(), block.mach.size());
  for (std::size_t i = 0; i < block.alpha_deg.size(); ++i)
    writeNumbers(out, field(block.alpha_deg[i]), &block.values[i * block.mach.size()], block.mach.size());
}

std::string count(std::size_t n) {
  if (n < 1 || n > 99) throw std::invalid_argument("writeC81: a grid of " + std::to_string(n) + " points, expected 1 to 99");
  return (n < 10 ? " " : "") + std::to_string(n);
}

}  // namespace

void writeC81(std::ostream& out, const C81Deck& deck) {
  std::string header = deck.name.substr(0, 30);
  header.resize(30, ' ');
  for (const C81Block* block : {&deck.lift, &deck.drag, &deck.moment}) {
    if (block->values.size() != block->mach.size() * block->alpha_deg.size())
      throw std::invalid_argument("writeC81: a block has " + std::to_string(block->values.size()) + " values, expected alpha x Mach = " +
                                  std::to_string(block->alpha_deg.size()) + " x " + std::to_string(block->mach.size()));
    header += count(block->mach.size()) + count(block->alpha_deg.size());
  }
  out << header << '\n';
  for (const C81Block* block : {&deck.lift, &deck.drag, &deck.moment}) writeBlock(out, *block);
}

}  // namespace heerk_rotor
