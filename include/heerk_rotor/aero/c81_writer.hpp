#pragma once
#include <ostream>

#include "heerk_rotor/aero/c81_deck.hpp"

namespace heerk_rotor {

/// Writes a deck that readC81 accepts. A number gets as many digits as its seven columns hold, at least two of them significant
/// for magnitudes from 1e-4 to 1e5. Throws std::invalid_argument if the deck does not fit the format: grids of different size
/// than their values, more than 99 grid points, numbers beyond seven columns.
void writeC81(std::ostream& out, const C81Deck& deck);

}  // namespace heerk_rotor
