#include "heerk_rotor/assembly/snapshot.hpp"

#include <unistd.h>

#include <clocale>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <locale>
#include <sstream>

#include <gtest/gtest.h>

#include "heerk_rotor/core/coupling_graph.hpp"
#include "heerk_rotor/integrate/tableau.hpp"

namespace heerk_rotor {
namespace {

/// Two of these, each driven by the other's acceleration, form a nonlinear algebraic loop, so that continuing bit by bit
/// needs the solver's start values and Jacobian too:  q'' = -k q - q^3 + 0.4 sin(u),  y = q''.
class Oscillator : public SubsystemModel {
 public:
  explicit Oscillator(double stiffness) : stiffness_(stiffness) {}
  std::vector<State> states() const override { return {{"q", "m", "displacement", 0.3}, {"v", "m/s", "velocity", 0.0}}; }
  std::vector<InputPort> inputs() const override {
    return {{"other", 1, "m/s^2", "acceleration of the other one"}, {"force", 1, "m/s^2", "from outside", Unconnected::kCommand}};
  }
  std::vector<OutputPort> outputs() const override { return {{"acceleration", 1, "m/s^2", "second derivative of q", {"other", "force"}}}; }
  StiffPart stiffPart() const override { return ModalStiff{Vector::Constant(1, std::sqrt(stiffness_)), Vector::Zero(1)}; }
  void evalOutput(Index, double, const In& x, const In& u, Out y) noexcept override { y[0] = acceleration(x, u); }
  void evalDerivatives(double, const In& x, const In& u, Out xdot) noexcept override {
    xdot[0] = x[1];
    xdot[1] = acceleration(x, u);
  }

 private:
  double acceleration(const In& x, const In& u) const { return -stiffness_ * x[0] - x[0] * x[0] * x[0] + 0.4 * std::sin(u[0]) + u[1]; }
  double stiffness_;
};

std::unique_ptr<Simulation> pairOfOscillators() {
  CouplingGraph graph;
  graph.add("a", std::make_unique<Oscillator>(4.0));
  graph.add("b", std::make_unique<Oscillator>(90.0), {{"q", -0.1}});
  graph.connect("a.acceleration", "b.other");
  graph.connect("b.acceleration", "a.other");
  StepOptions options;
  options.step = 0.01;
  options.method = "HEERK4";
  return std::make_unique<Simulation>(std::move(graph).build(), options);
}

bool sameBits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

template <class Numbers>
void expectSameBits(const Numbers& a, const Numbers& b, const char* what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (decltype(a.size()) i = 0; i < a.size(); ++i) EXPECT_TRUE(sameBits(a[i], b[i])) << what << "[" << i << "]: " << a[i] << ", " << b[i];
}

/// Every kind of number that can occur, with bit patterns that a decimal or careless format would lose.
Snapshot difficultSnapshot() {
  Snapshot snapshot;
  snapshot.configuration = "simulation: {step: 1e-3}\n\n  indented: \"\xc3\xa4\"\r\nend 4711 0123456789abcdef\nno newline at the end";
  Simulation::Checkpoint& c = snapshot.checkpoint;
  c.step = std::numeric_limits<std::uint64_t>::max();
  c.step0 = -12345;
  c.epoch = std::numeric_limits<std::uint32_t>::max();
  c.t0 = 0.1;
  c.h = 1.0 / 3.0;
  c.x = Vector(7);
  c.x << 0.0, -0.0, std::numeric_limits<double>::denorm_min(), -std::numeric_limits<double>::min() / 3.0, std::numeric_limits<double>::max(), 1e-17, 1234567.0;
  c.w = Vector(2);
  c.w << -M_PI, std::nextafter(1.0, 2.0);
  double nan_with_payload = 0.0;
  const std::uint64_t bits = 0xfff8000000001234ull;
  std::memcpy(&nan_with_payload, &bits, sizeof bits);
  c.solver_cache = {nan_with_payload, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), 1e300};
  return snapshot;
}

void expectEqual(const Snapshot& a, const Snapshot& b) {
  EXPECT_EQ(a.configuration, b.configuration);
  EXPECT_EQ(a.checkpoint.step, b.checkpoint.step);
  EXPECT_EQ(a.checkpoint.step0, b.checkpoint.step0);
  EXPECT_EQ(a.checkpoint.epoch, b.checkpoint.epoch);
  EXPECT_TRUE(sameBits(a.checkpoint.t0, b.checkpoint.t0));
  EXPECT_TRUE(sameBits(a.checkpoint.h, b.checkpoint.h));
  expectSameBits(a.checkpoint.x, b.checkpoint.x, "x");
  expectSameBits(a.checkpoint.w, b.checkpoint.w, "w");
  expectSameBits(a.checkpoint.solver_cache, b.checkpoint.solver_cache, "solver_cache");
}

struct CommaNumbers : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

class SnapshotTest : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directory(directory_); }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::string contents() const {
    std::ifstream stream(file_, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }
  void write(const std::string& text) const { std::ofstream(file_, std::ios::binary) << text; }

  /// Replaces a piece of a valid file and closes it again correctly, as a program with a fault would.
  void writeWith(const std::string& piece, const std::string& replacement) const {
    saveSnapshot(file_, difficultSnapshot());
    std::string text = contents();
    text.resize(text.rfind("\nend ") + 1);
    ASSERT_NE(text.find(piece), std::string::npos) << piece;
    text.replace(text.find(piece), piece.size(), replacement);
    std::uint64_t hash = 14695981039346656037ull;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
    char closing[64];
    std::snprintf(closing, sizeof closing, "end %zu %016llx\n", text.size(), static_cast<unsigned long long>(hash));
    write(text + closing);
  }

  std::string loadError() const {
    try {
      loadSnapshot(file_);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "accepted";
  }

  void expectLoadError(const std::string& part) const {
    const std::string error = loadError();
    EXPECT_NE(error.find(part), std::string::npos) << error;
    EXPECT_NE(error.find(file_), std::string::npos) << error << " does not name the file";
  }

  const std::string directory_ = testing::TempDir() + "snapshot_test_" + std::to_string(::getpid());
  const std::string file_ = directory_ + "/state.snapshot";
};

TEST_F(SnapshotTest, bringsEveryBitBack) {
  const Snapshot snapshot = difficultSnapshot();
  saveSnapshot(file_, snapshot);
  expectEqual(loadSnapshot(file_), snapshot);
}

TEST_F(SnapshotTest, holdsEmptyVectorsAndTexts) {
  saveSnapshot(file_, Snapshot{});
  expectEqual(loadSnapshot(file_), Snapshot{});
}

TEST_F(SnapshotTest, continuesBitwiseEqualToTheUninterruptedRun) {
  const Vector command = Vector::Constant(2, 0.05);
  const auto whole = pairOfOscillators();
  for (int i = 0; i < 137; ++i) ASSERT_EQ(whole->step(command), StepStatus::kOk);
  saveSnapshot(file_, {"", whole->checkpoint()});
  for (int i = 0; i < 200; ++i) ASSERT_EQ(whole->step(command), StepStatus::kOk);

  const auto continued = pairOfOscillators();
  const Vector initial = continued->state();
  continued->restore(loadSnapshot(file_).checkpoint);
  EXPECT_EQ(continued->stepCount(), 137u);
  EXPECT_NE(continued->state(), initial) << "the run must have moved for the comparison to mean something";
  for (int i = 0; i < 200; ++i) ASSERT_EQ(continued->step(command), StepStatus::kOk);
  expectSameBits(continued->state(), whole->state(), "x");
  EXPECT_EQ(continued->stateHash(), whole->stateHash());
  EXPECT_TRUE(sameBits(continued->time(), whole->time()));
}

TEST_F(SnapshotTest, isTheSameFileInAnyLocale) {
  saveSnapshot(file_, difficultSnapshot());
  const std::string classic = contents();
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new CommaNumbers));
  // strtod follows the C locale; where a machine has one with a decimal comma, it is tried as well.
  for (const char* name : {"C", "de_DE.UTF-8", "fr_FR.UTF-8", "de_DE.utf8"}) {
    if (std::setlocale(LC_ALL, name) == nullptr) continue;
    EXPECT_NO_THROW(saveSnapshot(file_, difficultSnapshot())) << name;
    EXPECT_EQ(contents(), classic) << name;
    EXPECT_NO_THROW(expectEqual(loadSnapshot(file_), difficultSnapshot())) << name;
  }
  std::setlocale(LC_ALL, "C");
  std::locale::global(before);
}

TEST_F(SnapshotTest, refusesEveryTruncatedFile) {
  saveSnapshot(file_, difficultSnapshot());
  const std::string text = contents();
  for (std::size_t size = 0; size < text.size(); ++size) {
    write(text.substr(0, size));
    EXPECT_NE(loadError(), "accepted") << size << " of " << text.size() << " bytes";
  }
  write(text.substr(0, text.size() / 2));
  expectLoadError("is truncated: " + std::to_string(text.size() / 2) + " bytes");
}

TEST_F(SnapshotTest, refusesEveryChangedByte) {
  saveSnapshot(file_, difficultSnapshot());
  const std::string text = contents();
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string changed = text;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    write(changed);
    EXPECT_NE(loadError(), "accepted") << "byte " << i;
  }
  std::string changed = text;
  changed[text.find("-12345") + 1] = '2';
  write(changed);
  expectLoadError("is damaged");
}

TEST_F(SnapshotTest, refusesWhatIsNoSnapshot) {
  write("simulation: {step: 1}\n");
  expectLoadError("is not a snapshot");
  write("");
  expectLoadError("is not a snapshot");
}

TEST_F(SnapshotTest, refusesAFormatFromTheFuture) {
  saveSnapshot(file_, difficultSnapshot());
  std::string text = contents();
  const std::string first = "heerk_rotor snapshot 1\n";
  ASSERT_EQ(text.compare(0, first.size(), first), 0);
  write("heerk_rotor snapshot 2\nsomething else\n");
  expectLoadError("has format version 2, written by a newer program; this one reads up to version 1");
  write("heerk_rotor snapshot one\n");
  expectLoadError("found version 'one', expected a whole number");
}

TEST_F(SnapshotTest, namesLineAndExpectationOfAnItemThatIsWrong) {
  writeWith("step0 -12345", "step0 -1x");
  expectLoadError("line 3: found '-1x', expected step0 as a whole number");
  writeWith("epoch 4294967295", "epoch 4294967296");
  expectLoadError("expected epoch as a whole number");
  writeWith("x 7\n", "x 8\n");
  expectLoadError("found 'w 2', expected x as a number");
  writeWith("configuration 5", "configuration 500");
  expectLoadError("ends before configuration");
  writeWith("configuration 5", "configuration 4");
  expectLoadError("expected the end");
  writeWith("t0 ", "start ");
  expectLoadError("expected t0");
}

TEST_F(SnapshotTest, neverHoldsAStateFromWhichNothingCanGoOn) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Snapshot snapshot = difficultSnapshot();
    snapshot.checkpoint.x[3] = bad;
    EXPECT_THROW(saveSnapshot(file_, snapshot), std::runtime_error);
    snapshot = difficultSnapshot();
    snapshot.checkpoint.w[1] = bad;
    EXPECT_THROW(saveSnapshot(file_, snapshot), std::runtime_error);
    EXPECT_FALSE(std::filesystem::exists(file_));
  }
  writeWith("x 7\n0x0p+0\n", "x 7\nnan:7ff8000000000000\n");
  expectLoadError("state x entry 0 is nan, expected a finite number");
  writeWith("x 7\n0x0p+0\n", "x 7\ninf\n");
  expectLoadError("state x entry 0 is inf, expected a finite number");
}

TEST_F(SnapshotTest, refusesFilesThatCannotBeRead) {
  expectLoadError("cannot be opened (No such file or directory)");
  std::filesystem::create_directory(file_);
  expectLoadError("is a directory");
}

}  // namespace
}  // namespace heerk_rotor
