// The real-time promise: after construction no step touches the heap.
#include <cstdlib>

#include "models/allocation_counter.hpp"
#include "models/rotor_runs.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

/// Keeps the optimiser from removing an allocation that nobody uses.
template <class T>
T* used(T* block) {
  asm volatile("" : : "r"(block) : "memory");
  return block;
}

TEST(HeapCalls, seesEveryWayToTheHeap) {
  if (!heapIsCounted()) GTEST_SKIP() << "the heap belongs to a sanitizer";
  const auto counted = [](auto&& work) {
    HeapCalls heap;
    work();
    return heap.count();
  };
  EXPECT_EQ(counted([] {}), 0u);
  EXPECT_GE(counted([] { std::free(used(std::malloc(10))); }), 1u);
  EXPECT_GE(counted([] { delete used(new Vector(100)); }), 4u);  // the object and its elements, there and back
  EXPECT_GE(counted([] {
    Vector v(10);
    v.resize(1000);
    used(v.data());
  }), 2u);
  EXPECT_GE(counted([] {
    struct alignas(64) Wide { double x[16]; };
    delete used(new Wide);
  }), 2u);
  EXPECT_GE(counted([] { std::string text(100, 'x'); used(&text); }), 2u);
}

/// Reads everything, as a publisher does.
struct Watcher : Observer {
  void observe(const Sample& sample) noexcept override {
    ++instants;
    sum += sample.y.sum() + sample.x.sum();
  }
  std::uint64_t instants = 0;
  double sum = 0.0;
};

void expectNoHeapCalls(const std::string& configuration, const Overrides& overrides, long steps) {
  if (!heapIsCounted()) GTEST_SKIP() << "the heap belongs to a sanitizer";
  auto simulation = buildSimulation(shipped(configuration, overrides));
  Watcher watcher;
  simulation->addObserver(watcher);
  Vector w = simulation->system().defaultCommand();
  const auto& names = simulation->system().commandNames();
  const auto command = [&](const std::string& name) { return std::find(names.begin(), names.end(), name) - names.begin(); };
  const Index collective = command("swashplate.collective"), lateral = command("swashplate.lateral_cyclic");
  const Index longitudinal = command("swashplate.longitudinal_cyclic"), speed = command("drive.speed");
  const Index wind = command("fuselage.wind_x"), push = command("fuselage.external_force_y");  // where there is such a fuselage
  const double nominal = w[speed];
  ASSERT_LT(std::max({collective, lateral, longitudinal, speed}), w.size());
  ASSERT_TRUE(advance(*simulation, 100, w));  // warm-up

  // Commands change all the time, beyond their limits too; the speed goes down, up and back.
  StepStatus status = StepStatus::kOk;
  std::uint64_t heap_calls = 0;
  {
    HeapCalls heap;
    for (long k = 0; k < steps && status == StepStatus::kOk; ++k) {
      if (k % 500 == 0) {
        const double phase = 1e-4 * static_cast<double>(k);
        w[collective] = 0.15 + 0.05 * std::sin(phase);
        w[lateral] = 0.04 * std::cos(3.0 * phase);
        w[longitudinal] = k % 70000 == 0 ? 0.5 : 0.03 * std::sin(2.0 * phase);
        w[speed] = nominal * (k < steps / 4 ? 1.0 : k < steps / 2 ? 0.9 : k < 3 * steps / 4 ? 1.07 : 1.0);
        if (wind < w.size()) w[wind] = -10.0 * (1.0 - std::cos(phase));
        if (push < w.size()) w[push] = 2000.0 * std::sin(phase);
      }
      status = simulation->step(w);
    }
    heap_calls = heap.count();
  }
  EXPECT_EQ(status, StepStatus::kOk) << simulation->failure().where << ": " << simulation->failure().cause;
  EXPECT_EQ(heap_calls, 0u);
  EXPECT_EQ(watcher.instants, static_cast<std::uint64_t>(steps) + 100u);
  EXPECT_TRUE(std::isfinite(watcher.sum));
}

TEST(Allocation, aMillionStepsOfTheControlledRotorNeverTouchTheHeap) { expectNoHeapCalls("lag_rotor_controlled.yaml", {}, 1000000); }

/// HEERK_ALLOCATION_STEPS=1000000 makes it as long as the test above (about 80 s).
TEST(Allocation, stepsOfTheElasticRotorNeverTouchTheHeap) {
  const char* const steps = std::getenv("HEERK_ALLOCATION_STEPS");
  expectNoHeapCalls("bo105.yaml", {}, steps != nullptr ? std::atol(steps) : 100000);
}

TEST(Allocation, stepsOfTheDualDiscRotorNeverTouchTheHeap) {
  if (!heapIsCounted()) GTEST_SKIP() << "the heap belongs to a sanitizer";
  for (const char* coordinates : {"modal", "physical"}) {
    auto simulation = buildSimulation(shipped("dual_disc.yaml", {std::string("subsystems.shaft.coordinates=") + coordinates, "subsystems.shaft.linearised_film_damping=1000.0",
                                                                 "subsystems.drive={type: speed_ramp, initial_speed_rpm: 4800, acceleration_rpm_per_s: 1.0e+4, start: 0.01}"}));
    Watcher watcher;
    simulation->addObserver(watcher);
    ASSERT_TRUE(advance(*simulation, 10));
    const Vector w = simulation->system().defaultCommand();
    bool good = true;
    std::uint64_t heap_calls = 0;
    {
      HeapCalls heap;
      good = advance(*simulation, 5000, w);
      heap_calls = heap.count();
    }
    EXPECT_TRUE(good);
    EXPECT_EQ(heap_calls, 0u);
    EXPECT_TRUE(std::isfinite(watcher.sum));
  }
}

TEST(Allocation, noMethodAndNoFormulationTouchesTheHeap) {
  for (const char* formulation : {"absolute_lag", "printed"})
    for (const char* method : {"HERK4", "HEERK2", "HEERK3", "HEERK4", "ETDRK4"})
      expectNoHeapCalls("lag_rotor_controlled.yaml", {std::string("simulation.formulation=") + formulation, std::string("simulation.integrator=") + method, "simulation.step=1.0e-4"}, 5000);
}

}  // namespace
}  // namespace heerk_rotor
