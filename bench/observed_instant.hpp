// What the benchmarks of publishing and recording share: one instant of a machine as observers see it.
#pragma once
#include <optional>

#include "step_benchmark.hpp"

namespace heerk_rotor {

/// A machine that has run for a while, and its present instant. The simulation must not be stepped while the sample is used.
class ObservedInstant : private Observer {
 public:
  explicit ObservedInstant(const std::string& config, const std::vector<std::string>& overrides = {}) : simulation_(make(config, overrides)) {
    const Vector command = simulation_->system().defaultCommand();
    for (int k = 0; k < 400; ++k) simulation_->step(command);
    simulation_->addObserver(*this);
    simulation_->observe(command);
    simulation_->removeObserver(*this);
  }

  const CoupledSystem& system() const { return simulation_->system(); }
  double stepSize() const { return simulation_->stepSize(); }
  /// The same values at another step number: recorders and rings look at it.
  Sample at(std::uint64_t step) const {
    Sample sample = *sample_;
    sample.step = step;
    sample.t = static_cast<double>(step) * stepSize();
    return sample;
  }

 private:
  void observe(const Sample& sample) noexcept override { sample_.emplace(sample); }
  std::unique_ptr<Simulation> simulation_;
  std::optional<Sample> sample_;
};

}  // namespace heerk_rotor
