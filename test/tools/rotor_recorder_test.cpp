#include <functional>

#include <gtest/gtest.h>

#include "heerk_rotor/tools/open_recorders.hpp"
#include "small_system.hpp"
#include "test_files.hpp"

namespace heerk_rotor {
namespace {

/// Four lag angles that never move: enough of a rotor for rotor messages.
class FrozenRotor final : public SubsystemModel {
 public:
  std::vector<State> states() const override { return {}; }
  std::vector<InputPort> inputs() const override { return {}; }
  std::vector<OutputPort> outputs() const override { return {{"lag", 4, "rad", "lead positive", {}, 1.0, {}, true}}; }
  void evalOutput(Index, double, const In&, const In&, Out y) noexcept override { y << 0.1, 0.2, 0.3, 0.4; }
  void evalDerivatives(double, const In&, const In&, Out) noexcept override {}
};

CoupledSystem frozenRotor() {
  CouplingGraph graph;
  graph.add("rotor", std::make_unique<FrozenRotor>());
  return std::move(graph).build();
}

std::string refusal(const std::function<void()>& open) {
  try {
    open();
  } catch (const RecordError& error) {
    return error.what();
  }
  return "(accepted)";
}

TEST(RotorRecorders, refuseASystemWithoutRotorQuantities) {
  const TestFolder folder;
  const CoupledSystem system = smallSystem();
  EXPECT_THROW(recordedKind(system), RecordError);
  EXPECT_EQ(recordedKind(frozenRotor()), MachineKind::kRotor);
  for (const auto& open : {openBagRecorder, openLcmRecorder})
    EXPECT_NE(refusal([&] { open(folder.file("x"), system, {}); }), "(accepted)");
  EXPECT_FALSE(std::filesystem::exists(folder.file("x"))) << "a refused output must not leave a file";
}

#if defined(HEERK_WITH_ROS) && defined(HEERK_WITH_LCM)

TEST(RotorRecorders, sayWhyAFileCannotBeOpened) {
  const CoupledSystem system = frozenRotor();
  for (const auto& open : {openBagRecorder, openLcmRecorder})
    EXPECT_NE(refusal([&] { open("/nowhere/at/all", system, {}); }), "(accepted)");
}

TEST(RotorRecorders, doNotStartOnADiskThatIsNearlyFull) {
  const TestFolder folder;
  const CoupledSystem system = frozenRotor();
  StateRecording recording;
  recording.disk_reserve = 1ull << 62;
  for (const auto& open : {openBagRecorder, openLcmRecorder}) {
    const std::string reason = refusal([&] { open(folder.file("x"), system, recording); });
    EXPECT_NE(reason.find("MiB left on the disk"), std::string::npos) << reason;
  }
}

#endif

}  // namespace
}  // namespace heerk_rotor
