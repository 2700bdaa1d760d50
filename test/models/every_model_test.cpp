// What every registered model must keep, whatever it models. A new type is tested here by being registered; one that has
// required parameters adds its minimal section to minimalParameters().
#include <algorithm>
#include <random>

#include "heerk_rotor/models/registry.hpp"
#include "models/allocation_counter.hpp"
#include "models/rotor_runs.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

std::string minimalParameters(const std::string& type) {
  // type -> ", key: value ...": what is required, and what must not be zero lest a term go untested
  static const std::map<std::string, std::string> parameters{
      {"mount", ", shaft_tilt_forward_deg: 5.0, hub_offset: [0.2, -0.1, 1.5], heading_deg: 40.0, roll_deg: -7.0, pitch_deg: 11.0, mass: 5.0, inertia: [3.0, 5.0, 4.0], "
                "products_of_inertia: [0.1, 0.3, -0.2], wind: [3.0, 2.0, 1.0], damping: [3.0, 2.0], gear_position: [0.3, 0.2, -1.2]"},
      {"blade_airloads", ", unsteady: beddoes"},
      {"elastic_mast", ", damping: 50.0"},
      {"shaft_rotor", ", segments: [0.2, 0.3, 0.2], discs: {nodes: [1, 2], mass: [5.0, 4.0], diametral_inertia: 0.02, polar_inertia: 0.03, unbalance: 1.0e-4, unbalance_angle_deg: [0.0, 70.0]}, "
                      "bearings: {nodes: [0, 3], stiffness_x: 1.0e+7, stiffness_y: 2.0e+7, damping_x: 100.0, damping_y: 50.0}, journals: [3, 2], linearised_film_damping: 200.0"},
      {"squeeze_film_damper", ", clearance: 0.3, length: 0.01, radius: 0.05, viscosity: 0.02"},
      {"lag_rotor", ", fuselage_damping_x: 900.0, lag_damper: 70.0"}};
  const auto found = parameters.find(type);
  return found == parameters.end() ? "" : found->second;
}

/// Options that change ports or equations: each is tested added to the minimal parameters.
std::vector<std::string> furtherParameters(const std::string& type) {
  static const std::map<std::string, std::vector<std::string>> parameters{
      {"elastic_mast", {", hub_inertia: 60.0"}},
      {"rigid_mast", {", hub_inertia: 60.0"}},
      {"mount", {", mode: rigid", ", mode: rigid, rotation: cw", ", mode: spring2", ", mode: spring2, rotation: cw", ", mode: spring6", ", mode: spring6, rotation: cw",
                 ", mode: free, rotation: cw"}},
      {"blade_airloads", {", virtual_mass: true", ", kinematics: small_angle"}},
      {"shaft_rotor", {", coordinates: physical", ", shear: true, mass_damping: 3.0", ", unbalance_in_exponential: false"}},
      {"squeeze_film_damper", {", film: full"}},
      {"speed_ramp", {", initial_speed_rpm: 100.0, acceleration_rpm_per_s: 300.0, start: 0.1"}},
      {"governed_drive", {", governor: false, engine_torque: 300.0"}},
      {"pitt_peters_inflow", {", induced_power_factor: 1.15, corrected_mass: true"}},
      {"swashplate", {", blades: 5, phase_deg: 20.0, delta3_deg: -15.0"}}};
  const auto found = parameters.find(type);
  return found == parameters.end() ? std::vector<std::string>{} : found->second;
}

struct Variant {
  std::string type;
  std::string formulation;
  bool second_order;
  std::string parameters;
  int option = 0;  // number of the set of parameters, 0 for the minimal one
};

std::ostream& operator<<(std::ostream& out, const Variant& v) { return out << v.type << v.parameters << ", " << v.formulation << (v.second_order ? ", hub terms" : ""); }

/// One model alone, built through the registry beside the rotors that other models look for.
struct Tested {
  explicit Tested(const Variant& variant) {
    const std::string terms = std::string(", second_order_hub_terms: ") + (variant.second_order ? "true" : "false");
    const std::string own = variant.type == "lag_rotor" ? terms : "";
    const Configuration configuration = Configuration::parse(
        "simulation: {rotor_speed: 41.0, step: 1.0e-3, formulation: " + variant.formulation + "}\n"
        "subsystems:\n  rotor: {type: lag_rotor, lag_damper: [70.0, 0.0, 90.0, 20.0]" + terms + "}\n  fe: {type: fe_rotor}\n  tested: {type: " + variant.type + own + variant.parameters + "}\n", "minimal");
    Problems problems;
    const SimulationSettings settings = readSimulationSettings(configuration, problems);
    Section section(configuration, "subsystems.tested", problems);
    section.word("type", "");
    for (const ModelType& type : modelTypes())
      if (type.name == variant.type) model = type.make(section, {configuration, settings, "tested", problems});
    section.finish();
    EXPECT_TRUE(problems.empty()) << problems.text();
    if (!model) throw std::runtime_error("no model");
    states = model->states();
    inputs = model->inputs();
    outputs = model->outputs();
    for (const InputPort& port : inputs) {
      input_begin.push_back(input_size);
      input_size += port.size;
    }
  }

  /// A plausible point: default inputs and initial states, moved at random; speeds and azimuths of a turning rotor.
  void randomPoint(std::mt19937& random, Vector& x, Vector& u) const {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    x = Vector::Zero(static_cast<Index>(states.size()));
    u = Vector::Zero(input_size);
    for (Index i = 0; i < x.size(); ++i) x[i] = states[static_cast<std::size_t>(i)].initial + 0.1 * unit(random);
    for (std::size_t p = 0; p < inputs.size(); ++p)
      for (Index i = 0; i < inputs[p].size; ++i) {
        double& value = u[input_begin[p] + i];
        value = (inputs[p].default_value.empty() ? 0.0 : inputs[p].default_value[static_cast<std::size_t>(i)]) + 0.3 * unit(random);
        if (inputs[p].name == "hub_motion" && i < 2) value += i == 0 ? 3.0 * unit(random) : 41.0;
      }
  }

  Vector output(std::size_t port, double t, const Vector& x, const Vector& u) {
    Vector y = Vector::Zero(outputs[port].size);
    model->evalOutput(static_cast<Index>(port), t, in(x), in(u), view(y));
    return y;
  }

  std::unique_ptr<SubsystemModel> model;
  std::vector<State> states;
  std::vector<InputPort> inputs;
  std::vector<OutputPort> outputs;
  std::vector<Index> input_begin;
  Index input_size = 0;
};

std::vector<Variant> variants() {
  std::vector<Variant> list;
  for (const ModelType& type : modelTypes())
    for (const char* formulation : {"absolute_lag", "printed"})
      for (const bool second_order : {true, false}) list.push_back({type.name, formulation, second_order, minimalParameters(type.name)});
  // Nothing in the further sets depends on the lag rotor's formulation.
  for (const ModelType& type : modelTypes()) {
    int option = 0;
    for (const std::string& parameters : furtherParameters(type.name)) list.push_back({type.name, "printed", true, minimalParameters(type.name) + parameters, ++option});
  }
  return list;
}

class EveryModel : public testing::TestWithParam<Variant> {
 protected:
  Tested tested{GetParam()};
  std::mt19937 random{11};
};
INSTANTIATE_TEST_SUITE_P(Registry, EveryModel, testing::ValuesIn(variants()), [](const auto& info) {
  return info.param.type + "_" + info.param.formulation + (info.param.second_order ? "_hub_terms" : "") +
         (info.param.option == 0 ? "" : "_option_" + std::to_string(info.param.option));
});

TEST_P(EveryModel, evaluatesToFiniteNumbers) {
  Vector x, u;
  for (int k = 0; k < 50; ++k) {
    tested.randomPoint(random, x, u);
    for (std::size_t p = 0; p < tested.outputs.size(); ++p) EXPECT_TRUE(tested.output(p, 0.1 * k, x, u).allFinite()) << tested.outputs[p].name;
    Vector xdot = Vector::Zero(x.size());
    tested.model->evalDerivatives(0.1 * k, in(x), in(u), view(xdot));
    EXPECT_TRUE(xdot.allFinite());
  }
}

TEST_P(EveryModel, outputsReadTheInputsTheyDeclareAndNoOthers) {
  Vector x, u;
  for (std::size_t p = 0; p < tested.outputs.size(); ++p) {
    const OutputPort& port = tested.outputs[p];
    for (std::size_t q = 0; q < tested.inputs.size(); ++q) {
      const bool declared = std::find(port.feedthrough.begin(), port.feedthrough.end(), tested.inputs[q].name) != port.feedthrough.end();
      bool reads = false;
      // An output that only switches (a limit reached) needs more points to be seen switching.
      for (int k = 0; k < 10 || (declared && !reads && k < 1000); ++k) {
        tested.randomPoint(random, x, u);
        const Vector before = tested.output(p, 0.3, x, u);
        for (Index i = 0; i < tested.inputs[q].size; ++i) {
          Vector moved = u;
          moved[tested.input_begin[q] + i] += 0.01;
          reads |= !(tested.output(p, 0.3, x, moved) == before);
        }
        if (declared) continue;
        // Not a bit may depend on it, not even a value that then is multiplied by zero.
        u.segment(tested.input_begin[q], tested.inputs[q].size).setConstant(std::nan(""));
        EXPECT_EQ(tested.output(p, 0.3, x, u), before) << port.name << " reads " << tested.inputs[q].name << " without declaring it";
      }
      EXPECT_EQ(reads, declared) << port.name << (declared ? " declares feedthrough it does not have of " : " has undeclared feedthrough of ") << tested.inputs[q].name;
    }
  }
}

TEST_P(EveryModel, remainderIsDerivativesMinusStiffPart) {
  const StiffPart part = tested.model->stiffPart();
  ASSERT_EQ(stiffSize(part), static_cast<Index>(tested.states.size()));
  const Matrix S = stiffMatrix(part);
  Vector x, u;
  for (int k = 0; k < 50; ++k) {
    tested.randomPoint(random, x, u);
    Vector f = Vector::Zero(x.size()), remainder = f;
    tested.model->evalDerivatives(0.2 * k, in(x), in(u), view(f));
    const Vector expected = f - S * x;
    if (tested.model->providesRemainder()) tested.model->evalRemainder(0.2 * k, in(x), in(u), view(remainder));
    else subtractStiff(part, in(x), in(f), view(remainder));
    // Round-off of the terms that cancel.
    const Vector scale = f.cwiseAbs() + S.cwiseAbs() * x.cwiseAbs();
    for (Index i = 0; i < x.size(); ++i) EXPECT_NEAR(remainder[i], expected[i], 1e-14 * scale[i] + 1e-300) << tested.states[static_cast<std::size_t>(i)].name;
    if (const auto* modal = std::get_if<ModalStiff>(&part); modal && modal->remainder_on_rates) {
      EXPECT_TRUE(remainder.head(modal->omega.size()).isZero(0.0));
    }
  }
}

TEST_P(EveryModel, derivativesReadNoInputThatIsOnlyForOutputs) {
  Vector x, u;
  for (std::size_t q = 0; q < tested.inputs.size(); ++q) {
    if (!tested.inputs[q].only_for_outputs) continue;
    for (int k = 0; k < 10; ++k) {
      tested.randomPoint(random, x, u);
      Vector f = Vector::Zero(x.size()), without = f;
      tested.model->evalDerivatives(0.3, in(x), in(u), view(f));
      u.segment(tested.input_begin[q], tested.inputs[q].size).setConstant(std::nan(""));
      tested.model->evalDerivatives(0.3, in(x), in(u), view(without));
      EXPECT_EQ(f, without) << tested.inputs[q].name;
    }
  }
}

TEST_P(EveryModel, narrowFormSaysTheSameAsTheCompleteOne) {
  const NarrowForm* form = tested.model->narrowForm();
  if (!form) return;
  ASSERT_EQ(form->C.cols(), static_cast<Index>(tested.states.size()));
  ASSERT_EQ(form->B.rows(), form->C.cols());
  Vector x, u;
  int answered = 0;
  for (int k = 0; k < 50; ++k) {
    tested.randomPoint(random, x, u);
    if (k % 2 == 0) u.head(tested.inputs[0].size).setZero();  // most models have a narrow form only while nothing drives them away from the nominal
    const Vector z = form->C * x;
    for (std::size_t p = 0; p < tested.outputs.size(); ++p) {
      if (!tested.model->narrowOutput(static_cast<Index>(p))) continue;
      const Vector expected = tested.output(p, 0.2 * k, x, u);
      Vector y = Vector::Zero(expected.size());
      tested.model->evalNarrowOutput(static_cast<Index>(p), 0.2 * k, in(z), in(u), view(y));
      EXPECT_LE((y - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.cwiseAbs().maxCoeff()) << tested.outputs[p].name;
    }
    Vector r = Vector::Zero(form->B.cols()), remainder = Vector::Zero(x.size());
    if (!tested.model->evalNarrowRemainder(0.2 * k, in(z), in(u), view(r))) continue;
    ++answered;
    tested.model->evalRemainder(0.2 * k, in(x), in(u), view(remainder));
    EXPECT_LE((form->B * r - remainder).cwiseAbs().maxCoeff(), 1e-13 * remainder.cwiseAbs().maxCoeff());
  }
  EXPECT_GT(answered, 20);
}

TEST_P(EveryModel, outputJacobiansAreTheDerivativesOfTheOutputs) {
  Vector x, u;
  for (std::size_t p = 0; p < tested.outputs.size(); ++p) {
    for (int k = 0; k < 5; ++k) {
      tested.randomPoint(random, x, u);
      Matrix jacobian = Matrix::Zero(tested.outputs[p].size, tested.input_size);
      if (!tested.model->outputJacobian(static_cast<Index>(p), 0.3, in(x), in(u), Eigen::Map<Matrix>(jacobian.data(), jacobian.rows(), jacobian.cols()))) continue;
      for (Index j = 0; j < tested.input_size; ++j) {
        // Central differences: truncation and round-off both near 1e-9 of the value with 1e-5.
        Vector up = u, down = u;
        up[j] += 1e-5;
        down[j] -= 1e-5;
        const Vector slope = (tested.output(p, 0.3, x, up) - tested.output(p, 0.3, x, down)) / 2e-5;
        const double tolerance = 1e-8 * std::max(1.0, tested.output(p, 0.3, x, u).cwiseAbs().maxCoeff());
        for (Index i = 0; i < slope.size(); ++i) EXPECT_NEAR(jacobian(i, j), slope[i], tolerance) << tested.outputs[p].name << ", " << i << ", " << j;
      }
    }
  }
}

TEST_P(EveryModel, evaluatesWithoutTouchingTheHeap) {
  if (!heapIsCounted()) GTEST_SKIP() << "the heap belongs to a sanitizer";
  Vector x, u;
  tested.randomPoint(random, x, u);
  Vector xdot = Vector::Zero(x.size());
  std::vector<Vector> y;
  std::vector<Matrix> jacobian;
  for (const OutputPort& port : tested.outputs) {
    y.push_back(Vector::Zero(port.size));
    jacobian.push_back(Matrix::Zero(port.size, tested.input_size));
  }
  const NarrowForm* form = tested.model->narrowForm();
  const Vector z = form ? Vector(form->C * x) : Vector();
  Vector r = Vector::Zero(form ? form->B.cols() : 0);
  std::uint64_t calls = 0;
  {
    HeapCalls heap;
    for (std::size_t p = 0; p < tested.outputs.size(); ++p) {
      const auto port = static_cast<Index>(p);
      tested.model->evalOutput(port, 0.1, in(x), in(u), view(y[p]));
      tested.model->outputJacobian(port, 0.1, in(x), in(u), Eigen::Map<Matrix>(jacobian[p].data(), jacobian[p].rows(), jacobian[p].cols()));
    }
    tested.model->evalDerivatives(0.1, in(x), in(u), view(xdot));
    tested.model->evalRemainder(0.1, in(x), in(u), view(xdot));
    if (form) tested.model->evalNarrowRemainder(0.1, in(z), in(u), view(r));
    calls = heap.count();
  }
  EXPECT_EQ(calls, 0u);
}

TEST_P(EveryModel, evaluatesPortsTogetherAsOneByOne) {
  Vector x, u, other_x, other_u;
  for (const bool held : {false, true}) {
    tested.randomPoint(random, other_x, other_u);
    if (!tested.outputs.empty()) tested.output(0, 0.2, other_x, other_u);
    tested.randomPoint(random, x, u);
    tested.model->holdState(held);
    std::vector<Vector> together;
    std::vector<PortValue> values;
    for (const OutputPort& port : tested.outputs) together.push_back(Vector::Constant(port.size, -1.0));
    for (std::size_t p = 0; p < tested.outputs.size(); ++p) values.push_back({static_cast<Index>(p), together[p].data(), together[p].size()});
    Vector rates = Vector::Constant(x.size(), -1.0), rates_after = rates;
    std::reverse(values.begin(), values.end());  // in any order
    tested.model->evalOutputs(values.data(), static_cast<Index>(values.size()), 0.4, in(x), in(u));
    // At the state that is held, but with other inputs.
    if (held && !tested.outputs.empty()) tested.model->evalOutputs(values.data(), 1, 0.4, in(x), in(other_u));
    if (held) tested.model->evalOutputs(values.data(), static_cast<Index>(values.size()), 0.4, in(x), in(u));
    // Rates while the state is held, after ports and after rates with other inputs.
    if (held) tested.model->evalRemainder(0.4, in(x), in(other_u), view(rates));
    tested.model->evalRemainder(0.4, in(x), in(u), view(rates));
    tested.model->holdState(false);
    tested.model->evalRemainder(0.3, in(other_x), in(other_u), view(rates_after));
    tested.model->evalRemainder(0.4, in(x), in(u), view(rates_after));
    EXPECT_EQ(rates, rates_after);
    for (std::size_t p = 0; p < tested.outputs.size(); ++p) EXPECT_EQ(together[p], tested.output(p, 0.4, x, u)) << tested.outputs[p].name;
  }
}

TEST_P(EveryModel, remembersNothing) {
  // The state vector is everything: evaluating elsewhere in between must not change a bit.
  Vector x, u, other_x, other_u;
  tested.randomPoint(random, x, u);
  tested.randomPoint(random, other_x, other_u);
  const auto everything = [&](double t, const Vector& at_x, const Vector& at_u) {
    Vector all = Vector::Zero(at_x.size());
    tested.model->evalDerivatives(t, in(at_x), in(at_u), view(all));
    for (std::size_t p = 0; p < tested.outputs.size(); ++p) {
      const Vector y = tested.output(p, t, at_x, at_u);
      all.conservativeResize(all.size() + y.size());
      all.tail(y.size()) = y;
    }
    return all;
  };
  const Vector before = everything(0.4, x, u);
  everything(7.0, other_x, other_u);
  EXPECT_EQ(everything(0.4, x, u), before);
}

TEST_P(EveryModel, saysWhatItsPortsMean) {
  for (const State& state : tested.states) EXPECT_FALSE(state.unit.empty() || state.meaning.empty()) << state.name;
  for (const InputPort& port : tested.inputs) EXPECT_FALSE(port.unit.empty() || port.meaning.empty()) << port.name;
  for (const OutputPort& port : tested.outputs) {
    EXPECT_FALSE(port.unit.empty() || port.meaning.empty()) << port.name;
    EXPECT_GT(port.nominal, 0.0) << port.name;
  }
}

}  // namespace
}  // namespace heerk_rotor
