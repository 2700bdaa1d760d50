// What it costs to hand an instant on or to record it, per step: on the step thread (reading and rings), and in recorders, which in real time have
// a thread of their own. Files are in a folder of their own below the temporary one, deleted afterwards, and begun anew before they fill the disk.
#include <atomic>

#include "heerk_rotor/realtime/instant_feed.hpp"
#include "heerk_rotor/tools/csv_recorder.hpp"
#include "heerk_rotor/tools/open_recorders.hpp"
#include "heerk_rotor/tools/signal_selection.hpp"
#include "observed_instant.hpp"
#include "tools/test_files.hpp"

#ifdef HEERK_WITH_LCM
#include <lcm/lcm-cpp.hpp>

#include "heerk_rotor/lcm/conversions.hpp"
#endif

namespace heerk_rotor {
namespace {

constexpr std::uint64_t kMostInstants = 50000;  // per file: about 50 MB

bool isShaft(const std::string& config) { return config == "dual_disc.yaml"; }

/// All that the step thread does for readers: an instant read, checked, put into the newest value and into `rings` rings that somebody empties.
template <class Kind>
void handOnKind(benchmark::State& state, const std::string& config) {
  const ObservedInstant instant(config);
  InstantFeed<Kind> feed(instant.system(), 360);
  std::vector<std::unique_ptr<SnapshotRing<typename Kind::Instant>>> rings;
  for (long i = 0; i < state.range(0); ++i) {
    rings.push_back(std::make_unique<SnapshotRing<typename Kind::Instant>>(1024));
    feed.addRing(*rings.back(), 1);
  }
  std::uint64_t step = 1000;
  typename Kind::Instant taken;
  for (auto _ : state) {
    feed.observe(instant.at(++step));
    if (step % 512 != 0) continue;
    state.PauseTiming();
    for (auto& ring : rings)
      while (ring->pop(taken)) {
      }
    state.ResumeTiming();
  }
}

void handOn(benchmark::State& state, const std::string& config) { isShaft(config) ? handOnKind<ShaftKind>(state, config) : handOnKind<RotorKind>(state, config); }

/// A recorder of `simulate`, per recorded instant; what is left in buffers is written within the measurement.
template <class Open>
void record(benchmark::State& state, const std::string& config, const std::string& name, const Open& open) {
  const ObservedInstant instant(config);
  const TestFolder folder;
  std::unique_ptr<Recorder> recorder;
  try {
    recorder = open(folder.file(name), instant);
  } catch (const RecordError& error) {
    return state.SkipWithError(error.what());
  }
  std::uint64_t step = 0;
  for (auto _ : state) {
    recorder->observe(instant.at(++step));
    if (step % kMostInstants != 0) continue;
    recorder->close();
    state.PauseTiming();
    recorder = open(folder.file(name), instant);
    state.ResumeTiming();
  }
  recorder->close();
  if (recorder->failed()) state.SkipWithError("recording failed");
}

void csv(benchmark::State& state, const std::string& config) {
  record(state, config, "x.csv", [](const std::string& file, const ObservedInstant& instant) -> std::unique_ptr<Recorder> {
    return std::make_unique<CsvRecorder>(file, instant.system(), selectSignals(instant.system(), {}), 1.0, RecordGrid{});
  });
}
void bag(benchmark::State& state, const std::string& config) {
  record(state, config, "x.bag", [](const std::string& file, const ObservedInstant& instant) { return openBagRecorder(file, instant.system(), {}); });
}
void lcmLog(benchmark::State& state, const std::string& config) {
  record(state, config, "x.lcm", [](const std::string& file, const ObservedInstant& instant) { return openLcmRecorder(file, instant.system(), {}); });
}

#ifdef HEERK_WITH_LCM
/// The sender's work per instant: message filled, encoded, given to UDP multicast of this machine; nobody listens.
template <class Kind>
void lcmPublishKind(benchmark::State& state, const std::string& config) {
  const ObservedInstant instant(config);
  const typename Kind::View view(instant.system());
  typename Kind::Instant reading;
  view.read(instant.at(1000), reading.reading);
  lcm::LCM lcm("udpm://239.255.76.67:7669?ttl=0");
  typename LcmState<typename Kind::Instant>::Message message;
  if (!lcm.good()) return state.SkipWithError("no route for multicast");
  for (auto _ : state) {
    toLcmState(reading, {}, message);
    if (lcm.publish(LcmState<typename Kind::Instant>::kChannel, &message) != 0) return state.SkipWithError("LCM refused a message");
  }
}

void lcmPublish(benchmark::State& state, const std::string& config) { isShaft(config) ? lcmPublishKind<ShaftKind>(state, config) : lcmPublishKind<RotorKind>(state, config); }
BENCHMARK_CAPTURE(lcmPublish, bo105, "bo105.yaml");
BENCHMARK_CAPTURE(lcmPublish, dual_disc, "dual_disc.yaml");
#endif

BENCHMARK_CAPTURE(handOn, bo105, "bo105.yaml")->ArgName("rings")->Arg(0)->Arg(1)->Arg(3);
BENCHMARK_CAPTURE(handOn, dual_disc, "dual_disc.yaml")->ArgName("rings")->Arg(0)->Arg(1)->Arg(3);
BENCHMARK_CAPTURE(csv, bo105, "bo105.yaml");
BENCHMARK_CAPTURE(csv, dual_disc, "dual_disc.yaml");
BENCHMARK_CAPTURE(bag, bo105, "bo105.yaml");
BENCHMARK_CAPTURE(bag, dual_disc, "dual_disc.yaml");
BENCHMARK_CAPTURE(lcmLog, bo105, "bo105.yaml");
BENCHMARK_CAPTURE(lcmLog, dual_disc, "dual_disc.yaml");

}  // namespace
}  // namespace heerk_rotor
