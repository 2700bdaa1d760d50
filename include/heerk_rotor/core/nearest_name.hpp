#pragma once
#include <string>
#include <vector>

namespace heerk_rotor {

/// The known name with the smallest edit distance to `name`, or "" when none is close (distance above half the length).
std::string nearestName(const std::string& name, const std::vector<std::string>& known);

/// " (did you mean 'x'?)" or "".
std::string didYouMean(const std::string& name, const std::vector<std::string>& known);

}  // namespace heerk_rotor
