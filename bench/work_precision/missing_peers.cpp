// What the comparison does without where a library is missing.
#include "integration.hpp"

namespace heerk_rotor::work_precision {

#ifndef HEERK_WITH_SUNDIALS
std::vector<Family> cvodePeers(const Problem&, const Vector&, bool) { return {}; }
std::vector<Family> arkodePeers(const Problem&, const Vector&, bool) { return {}; }
std::vector<Family> idaPeers(const Problem&, const Vector&, bool) { return {}; }
std::unique_ptr<Integration> tightExplicit(const Problem&, const Vector&) { return nullptr; }
#endif

#ifndef HEERK_WITH_ODEINT
std::vector<Family> odeintPeers(const Problem&, const Vector&, bool) { return {}; }
#endif

}  // namespace heerk_rotor::work_precision
