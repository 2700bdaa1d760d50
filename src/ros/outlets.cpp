#include "heerk_rotor/ros/outlets.hpp"

#include <algorithm>
#include <cmath>

#include "heerk_rotor/assembly/machine_kind.hpp"
#include "heerk_rotor/config/simulation_settings.hpp"
#include "heerk_rotor/ros/display.hpp"
#include "heerk_rotor/ros/failure_report.hpp"
#include "heerk_rotor/ros/lcm_link.hpp"
#include "heerk_rotor/ros/state_publisher.hpp"

namespace heerk_rotor {
namespace {

constexpr double kRecorderSeconds = 10.0;  // of steps that a recorder's ring holds (interface)
constexpr double kReaderSeconds = 1.0;     // of a publisher's ring

/// Steps of one revolution, for the history before a failure.
std::size_t revolutionSteps(const Configuration& configuration, double step) {
  Problems ignored;  // the simulation has been built from it
  const double steps = std::ceil(readSimulationSettings(configuration, ignored).revolution() / step) + 1.0;
  return static_cast<std::size_t>(std::clamp(steps, 2.0, 100000.0));
}

std::size_t ringCapacity(const Outlets::Context& context, double seconds, int every) {
  const double steps = seconds * std::max(1.0, context.parameters.real_time_factor) / context.simulation.stepSize();
  return static_cast<std::size_t>(std::max(256.0, std::ceil(steps / every)));
}

template <class Kind>
class KindOutlets final : public Outlets {
 public:
  explicit KindOutlets(const Context& context)
      : as_fast_as_possible_(context.parameters.real_time_factor == 0.0),
        feed_(context.simulation.system(), revolutionSteps(context.configuration, context.simulation.stepSize())),
        state_ring_(ringCapacity(context, kReaderSeconds, context.rates.publish_every)),
        state_publisher_(context.node, state_ring_, {context.stamps, context.parameters.publish_clock, context.overruns}),
        view_publisher_(feed_.newest(), display(feed_, context.node, context.configuration), context.stamps),
        lcm_(context.parameters, lcmPlan(context), context.stamps, context.commands, context.overruns) {
    feed_.addRing(state_ring_, static_cast<std::uint64_t>(context.rates.publish_every));
  }

  Feed& feed() override { return feed_; }

  History history() const override {
    const auto instants = feed_.history();
    return {instants.size(), [instants](const std::string& file) { writeFailureHistory(file, instants); }};
  }

  void connect(RotorDiagnostics& diagnostics, const std::atomic<bool>& stop) override {
    diagnostics.addReader({"ROS", [this] { return state_publisher_.published(); }, &state_ring_});
    lcm_.connect(feed_, diagnostics, as_fast_as_possible_, stop);
  }

  void start() override {
    state_publisher_.start();
    view_publisher_.start();
    lcm_.start();
  }

  void stop() override {
    state_publisher_.stop();
    view_publisher_.stop();
    lcm_.stop();
  }

  std::string recordingProblem() const override { return lcm_.recordingProblem(); }

 private:
  static typename LcmLink<Kind>::Plan lcmPlan(const Context& context) {
    const double recorded = context.parameters.duration > 0.0 ? context.parameters.duration : 60.0;  // [s]; endless: room for a minute at least
    return {context.rates.lcm_every, ringCapacity(context, kReaderSeconds, context.rates.lcm_every), ringCapacity(context, kRecorderSeconds, 1),
            recorded / context.simulation.stepSize()};
  }

  const bool as_fast_as_possible_;
  InstantFeed<Kind> feed_;
  SnapshotRing<typename Kind::Instant> state_ring_;
  StatePublisher<typename Kind::Instant> state_publisher_;
  ViewPublisher<typename Kind::Picture> view_publisher_;
  LcmLink<Kind> lcm_;
};

}  // namespace

std::unique_ptr<Outlets> openOutlets(const Outlets::Context& context) {
  if (machineKind(context.simulation.system()) == MachineKind::kShaft) return std::make_unique<KindOutlets<ShaftKind>>(context);
  return std::make_unique<KindOutlets<RotorKind>>(context);
}

}  // namespace heerk_rotor
