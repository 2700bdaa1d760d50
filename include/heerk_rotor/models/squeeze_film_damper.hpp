#pragma once
#include "heerk_rotor/core/subsystem_model.hpp"
#include "heerk_rotor/shaft/squeeze_film.hpp"

namespace heerk_rotor {

/// Squeeze-film damper around a journal that moves but does not turn (Liu & Zhang, eq. 15 corrected; see squeeze_film.hpp).
/// Input: journal_motion (x, y from the static position [m], then their rates [m/s]), of a shaft_rotor.
/// Outputs: film_force on the journal [N], for its journal_force; eccentricity_ratio (from the housing centre, not limited);
/// film_clamped (1 while the ratio exceeds 0.999, where the force is that at 0.999: the model is no longer valid there).
/// The static position lies (static_eccentricity_x, _y) parts of the clearance from the housing centre. No states.
class SqueezeFilmDamper : public SubsystemModel {
 public:
  struct Parameters {
    SqueezeFilm::Parameters film;
    double static_eccentricity_x = 0.0;   // [parts of the clearance]
    double static_eccentricity_y = -0.2;  // [parts of the clearance]
  };
  explicit SqueezeFilmDamper(const Parameters& parameters) : p_(parameters), film_(parameters.film), per_clearance_(1.0 / parameters.film.clearance) {}

  std::vector<State> states() const override { return {}; }
  std::vector<InputPort> inputs() const override;
  std::vector<OutputPort> outputs() const override;
  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override;
  void evalDerivatives(double, const In&, const In&, Out) noexcept override {}

 private:
  Parameters p_;
  SqueezeFilm film_;
  double per_clearance_;  // [1/m]
};

}  // namespace heerk_rotor
