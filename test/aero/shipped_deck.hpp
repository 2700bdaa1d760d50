#pragma once
#include <stdexcept>
#include <string>

#include "heerk_rotor/aero/c81_reader.hpp"

namespace heerk_rotor::test {

/// config/airfoils/naca0012_analytic.c81
inline C81Deck shippedDeck() {
  C81Reading reading = readC81File(std::string(HEERK_SOURCE_DIR) + "/config/airfoils/naca0012_analytic.c81");
  if (!reading.ok()) throw std::runtime_error(reading.problems.front());
  return std::move(reading.deck);
}

/// The same with the negative half mirrored from the positive one, free from the rounding of the file.
inline C81Deck symmetricDeck() {
  C81Deck deck = shippedDeck();
  for (C81Block* block : {&deck.lift, &deck.moment}) {
    const std::size_t n = block->alpha_deg.size();
    for (std::size_t i = 0; i < n / 2; ++i)
      for (std::size_t j = 0; j < block->mach.size(); ++j) block->value(i, j) = -block->value(n - 1 - i, j);
  }
  return deck;
}

}  // namespace heerk_rotor::test
