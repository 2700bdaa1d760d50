#pragma once
#include <istream>
#include <string>
#include <vector>

#include "heerk_rotor/aero/c81_deck.hpp"

namespace heerk_rotor {

/// What reading a deck gave. The deck may be used only if `problems` is empty.
struct C81Reading {
  C81Deck deck;
  std::vector<std::string> problems;  // "file:line: found ..., expected ..."
  std::vector<std::string> warnings;  // likewise; the deck can be used
  bool ok() const { return problems.empty(); }
};

/// Reads a C81 deck. The format has fixed columns (numbers may touch each other):
///   header  A30,6I2   name, then the counts of (Mach, alpha) for lift, drag and moment; lines before it are a preamble
///   block   7X,9F7.0  Mach numbers; continuation lines 7X,9F7.0 beyond nine
///           F7.0,9F7.0  alpha [deg] and one value per Mach number; continuation as above
/// A number without decimal point is a whole number. Text behind the expected columns and after the last row is ignored.
/// Problems: missing or malformed numbers, grids that do not increase, alpha outside +-180 deg, an early end.
/// Warnings: one block repeated in the others (placeholder decks), negative drag, Mach numbers that end below 0.8, alpha that
/// does not span +-180 deg, values that differ at -180 and +180 deg.
/// `name` stands for the file in the messages.
C81Reading readC81(std::istream& in, const std::string& name);

/// The same from a file; one that cannot be opened is a problem.
C81Reading readC81File(const std::string& path);

}  // namespace heerk_rotor
