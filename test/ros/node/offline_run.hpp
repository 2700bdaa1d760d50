#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "heerk_rotor/assembly/build_simulation.hpp"
#include "heerk_rotor/assembly/rotor_view.hpp"
#include "heerk_rotor/assembly/shaft_view.hpp"
#include "heerk_rotor/config/configuration.hpp"

namespace heerk_rotor {

/// The same configuration without node, threads and clock: what the node publishes must equal it bit by bit.
template <class View>
class OfflineRunOf : public Observer {
 public:
  explicit OfflineRunOf(const std::string& file, const std::vector<std::string>& overrides = {})
      : simulation_(buildSimulation(Configuration::load(file, overrides))), view_(simulation_->system()), commands_(simulation_->system()), w_(simulation_->system().defaultCommand()) {
    simulation_->addObserver(*this);
  }

  void command(double collective, double lateral_cyclic, double longitudinal_cyclic) {
    w_[commands_.collective()] = collective;
    w_[commands_.lateralCyclic()] = lateral_cyclic;
    w_[commands_.longitudinalCyclic()] = longitudinal_cyclic;
  }

  double stepSize() const { return simulation_->stepSize(); }

  /// The reading of the instant with that step number, which must not be before the present one.
  const typename View::Reading& at(std::uint64_t step) {
    while (simulation_->stepCount() < step) EXPECT_EQ(simulation_->step(w_), StepStatus::kOk);
    EXPECT_EQ(simulation_->observe(w_), StepStatus::kOk);
    return reading_;
  }

  void observe(const Sample& sample) noexcept override { view_.read(sample, reading_); }

 private:
  std::unique_ptr<Simulation> simulation_;
  View view_;
  CommandView commands_;
  Vector w_;
  typename View::Reading reading_;
};

using OfflineRun = OfflineRunOf<RotorView>;
using OfflineShaft = OfflineRunOf<ShaftView>;

/// ROS and LCM state messages have the same field names.
template <class Message>
void expectSamePhysics(const Message& message, const RotorReading& reading) {
  ASSERT_EQ(static_cast<std::uint64_t>(message.step), reading.step);
  EXPECT_EQ(message.sim_time, reading.sim_time);
  EXPECT_EQ(message.azimuth, reading.azimuth);
  EXPECT_EQ(message.rotor_speed, reading.rotor_speed);
  ASSERT_EQ(message.lag.size(), static_cast<std::size_t>(reading.blades));
  ASSERT_EQ(message.pitch.size(), static_cast<std::size_t>(reading.blades));
  for (std::size_t k = 0; k < message.lag.size(); ++k) {
    EXPECT_EQ(message.lag[k], reading.lag[k]);
    EXPECT_EQ(message.lag_rate[k], reading.lag_rate[k]);
    EXPECT_EQ(message.pitch[k], reading.pitch[k]);
  }
  EXPECT_EQ(message.lag_cosine, reading.lag_cosine);
  EXPECT_EQ(message.thrust_coefficient, reading.thrust_coefficient);
  EXPECT_EQ(message.collective, reading.collective);
  EXPECT_EQ(message.lateral_cyclic, reading.lateral_cyclic);
  EXPECT_EQ(message.longitudinal_cyclic, reading.longitudinal_cyclic);
}

template <class Message>
void expectSameShaft(const Message& message, const ShaftReading& reading) {
  ASSERT_EQ(static_cast<std::uint64_t>(message.step), reading.step);
  EXPECT_EQ(message.sim_time, reading.sim_time);
  EXPECT_EQ(message.azimuth, reading.azimuth);
  EXPECT_EQ(message.rotor_speed, reading.rotor_speed);
  ASSERT_EQ(message.disc_x.size(), static_cast<std::size_t>(reading.discs));
  ASSERT_EQ(message.disc_y.size(), static_cast<std::size_t>(reading.discs));
  for (std::size_t k = 0; k < message.disc_x.size(); ++k) {
    EXPECT_EQ(message.disc_x[k], reading.disc_x[k]);
    EXPECT_EQ(message.disc_y[k], reading.disc_y[k]);
  }
  EXPECT_EQ(message.journal_x, reading.journal_x);
  EXPECT_EQ(message.journal_y, reading.journal_y);
  EXPECT_EQ(message.eccentricity_ratio, reading.eccentricity_ratio);
  EXPECT_EQ(message.bearing_force_x, reading.bearing_force_x);
  EXPECT_EQ(message.bearing_force_y, reading.bearing_force_y);
  EXPECT_EQ(message.film_force_x, reading.film_force_x);
  EXPECT_EQ(message.film_force_y, reading.film_force_y);
}

}  // namespace heerk_rotor
