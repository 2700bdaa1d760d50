#include "heerk_rotor/core/nearest_name.hpp"

#include <algorithm>
#include <cctype>

namespace heerk_rotor {
namespace {

/// Insertions, deletions, substitutions and swaps of neighbours that turn a into b (optimal string alignment).
std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, substitution});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

std::string lowerCase(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

std::string nearestName(const std::string& name, const std::vector<std::string>& known) {
  std::string nearest;
  std::size_t least = 0;        // distance without regard to case: "herk4" means HERK4, not HEERK4
  std::size_t least_exact = 0;  // decides between names that differ in case only
  for (const std::string& candidate : known) {
    const std::size_t distance = editDistance(lowerCase(name), lowerCase(candidate));
    if (2 * distance > std::max(name.size(), candidate.size())) continue;
    const std::size_t exact = editDistance(name, candidate);
    if (nearest.empty() || distance < least || (distance == least && exact < least_exact)) {
      nearest = candidate;
      least = distance;
      least_exact = exact;
    }
  }
  return nearest;
}

std::string didYouMean(const std::string& name, const std::vector<std::string>& known) {
  const std::string nearest = nearestName(name, known);
  return nearest.empty() ? "" : " (did you mean '" + nearest + "'?)";
}

}  // namespace heerk_rotor
