#include "heerk_rotor/tools/simulate_options.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <CLI/CLI.hpp>

#include "heerk_rotor/config/problems.hpp"
#include "heerk_rotor/core/nearest_name.hpp"

namespace heerk_rotor {
namespace {

const char* const kFooter =
    "FILE ends in .csv (signals), .bag (the node's topics) or .lcm (event log of ROTOR_STATE). Row 0 is the initial instant.\n"
    "All values are SI and radians. Exit status: 0 done; 1 an output could not be written completely; 2 bad command line or\n"
    "configuration; 3 no trim was found, the solution became non-finite or the solver stalled (the last revolution before it is written to\n"
    "OUTPUT.failure.csv); 128 + signal number when interrupted (130 after Ctrl-C), with everything recorded until then.\n"
    "After --trim or --stability a run follows only when one of --duration, --revolutions, --output, --save-snapshot asks for it.\n"
    "A sweep runs the configuration once for every combination of values and writes one line per run: the values, status, and of every signal\n"
    "final value, mean and half peak-to-peak over the last revolution, min and max over the run. KEY=3e4,3e6 lists values, KEY=FROM:TO:COUNT has\n"
    "equal steps, KEY=FROM:TO:COUNT:log equal ratios. A failed run is a line with the reason, and exit status 3.\n"
    "Example: simulate config/lag_rotor.yaml --set subsystems.mast.stiffness=3e6 --duration 10 --output lag.csv\n"
    "         simulate config/bo105.yaml --sweep subsystems.mast.stiffness=3e5:3e7:9:log --revolutions 20 --output sweep.csv";

constexpr std::uint64_t kMostJobs = 1024;

/// Words of the command line before they mean anything.
struct Words {
  std::string duration, revolutions, every, signals, coupling, jobs;
};

void declare(CLI::App& app, SimulateOptions& options, Words& words) {
  app.add_option("CONFIG", options.configuration, "configuration file (YAML)");
  app.add_option("--set", options.overrides, "override any key of the configuration, list elements by index; repeatable")
      ->type_name("KEY=VALUE")->allow_extra_args(false);
  app.add_option("--duration", words.duration, "length of the run [s] (default: simulation.duration)")->type_name("S");
  app.add_option("--revolutions", words.revolutions, "length of the run in revolutions at the nominal rotor speed")->type_name("N");
  app.add_option("--output", options.outputs, "record to this file; repeatable")->type_name("FILE")->allow_extra_args(false);
  app.add_option("--signals", words.signals, "signals of .csv outputs, or 'all' (default: the published ones)")->type_name("A,B,...");
  app.add_option("--every", words.every, "record every N-th step (default 1)")->type_name("N");
  app.add_option("--commands", options.commands, "columns time, collective, lateral_cyclic, longitudinal_cyclic; held until the next row")
      ->type_name("FILE.csv");
  app.add_option("--save-snapshot", options.save_snapshot, "write the final state, to be continued later")->type_name("FILE");
  app.add_option("--load-snapshot", options.load_snapshot, "continue from a snapshot; CONFIG may be left out")->type_name("FILE");
  app.add_flag("--trim", options.trim, "find the periodic motion and controls that the section trim asks for; a run goes on from there");
  app.add_option("--save-start", options.save_start, "write the final state as a start, with --trim the trimmed one; loaded by the key simulation.start")->type_name("FILE.yaml");
  app.add_flag("--stability", options.stability, "eigenvalues of the maps of one revolution and of one step at the start");
  app.add_option("--show-coupling", words.coupling, "print subsystems, connections, loops and their sparsity; draw them into a picture")
      ->type_name("[FILE.svg]")->expected(0, 1);
  app.add_flag("--evaluation-counts", options.evaluation_counts, "evaluations of f and g per step and subsystem, over one revolution");
  app.add_option("--sweep", options.sweeps, "one run for each of these values of a key; repeated: for all combinations")
      ->type_name("KEY=VALUES")->allow_extra_args(false);
  app.add_option("--sweep-file", options.sweep_file, "runs as rows under keys (.csv), or as a list of KEY=VALUE lists (.yaml)")->type_name("FILE");
  app.add_option("--jobs", words.jobs, "runs of a sweep at a time (default: one per processor); the result does not depend on it")->type_name("N");
  app.add_flag("--list-signals", options.list_signals, "print name, unit and meaning of every signal and stop");
  app.add_flag("--json", options.json, "print the summary of the run as one JSON object");
  app.add_flag("--quiet", options.quiet, "no progress bar, no summary, no warnings");
  app.footer(kFooter);
}

/// Unknown options by name with the nearest known one; stray words only where no unknown option explains them.
void reportRemaining(const CLI::App& app, Problems& problems) {
  std::vector<std::string> known;
  for (const CLI::Option* option : app.get_options())
    if (!option->get_positional()) known.push_back(option->get_name());
  bool unknown_option = false;
  for (const std::string& word : app.remaining())
    if (word.size() > 1 && word.front() == '-') {
      const std::string name = word.substr(0, word.find('='));
      problems.add({"command line", "option", word, "one that exists, see --help" + didYouMean(name, known)});
      unknown_option = true;
    }
  if (unknown_option) return;
  for (const std::string& word : app.remaining()) problems.add({"command line", "argument", word, "one CONFIG only"});
}

std::optional<double> readNumber(const std::string& word, const std::string& key, const std::string& unit, Problems& problems) {
  if (word.empty()) return {};
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (end != word.c_str() + word.size() || !std::isfinite(value) || value < 0.0) {
    problems.add({"command line", key, word, "a finite number >= 0 " + unit});
    return {};
  }
  return value;
}

std::uint64_t readCount(const std::string& word, const std::string& key, Problems& problems) {
  if (word.empty()) return 1;
  errno = 0;
  char* end = nullptr;
  const unsigned long long value = std::strtoull(word.c_str(), &end, 10);
  const bool digits_only = word.find_first_not_of("0123456789") == std::string::npos;
  if (!digits_only || errno == ERANGE || value == 0) {
    problems.add({"command line", key, word, "a whole number of steps from 1 to 18446744073709551615"});
    return 1;
  }
  return value;
}

std::optional<std::uint64_t> readJobs(const std::string& word, Problems& problems) {
  if (word.empty()) return {};
  const bool digits_only = word.size() <= 4 && word.find_first_not_of("0123456789") == std::string::npos;
  const std::uint64_t value = digits_only ? std::strtoull(word.c_str(), nullptr, 10) : 0;
  if (value >= 1 && value <= kMostJobs) return value;
  problems.add({"command line", "--jobs", word, "a whole number from 1 to " + std::to_string(kMostJobs)});
  return {};
}

/// What a sweep needs, and what has no meaning with many runs.
void checkSweep(const SimulateOptions& options, Problems& problems) {
  if (!options.isSweep()) {
    if (options.jobs) problems.add({"command line", "--jobs", std::to_string(*options.jobs), "a sweep: --sweep KEY=VALUES or --sweep-file FILE"});
    return;
  }
  if (options.list_signals) return;
  if (options.outputs.size() != 1 || outputKind(options.outputs.front()) != OutputKind::kCsv)
    problems.add({"command line", "--output", options.outputs.empty() ? "nothing" : std::to_string(options.outputs.size()) + " files, first " + options.outputs.front(),
                  "one FILE.csv, the table of the sweep"});
  const std::vector<std::pair<const char*, bool>> single = {{"--load-snapshot", !options.load_snapshot.empty()}, {"--save-snapshot", !options.save_snapshot.empty()},
                                                            {"--save-start", !options.save_start.empty()},       {"--stability", options.stability},
                                                            {"--show-coupling", options.show_coupling.has_value()}, {"--evaluation-counts", options.evaluation_counts}};
  for (const auto& [name, given] : single)
    if (given) problems.add({"command line", name, "given with a sweep", "one run, without --sweep and --sweep-file"});
}

std::vector<std::string> splitSignals(const std::string& text, Problems& problems) {
  std::vector<std::string> names;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    std::string name = text.substr(begin, end - begin);
    name.erase(0, name.find_first_not_of(' '));
    name.erase(name.find_last_not_of(' ') + 1);
    if (name.empty()) problems.add({"command line", "--signals", text, "names separated by single commas"});
    else names.push_back(name);
    begin = end + 1;
  }
  return names;
}

/// Whether two names mean one file, also through links and other spellings.
bool sameFile(const std::string& a, const std::string& b) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  return fs::absolute(a, error).lexically_normal() == fs::absolute(b, error).lexically_normal();
}

/// Every written file must be a different one, and none may be a file that is read.
void checkFiles(const SimulateOptions& options, Problems& problems) {
  std::vector<std::pair<std::string, std::string>> taken;  // option, file
  if (!options.configuration.empty()) taken.emplace_back("CONFIG", options.configuration);
  if (!options.commands.empty()) taken.emplace_back("--commands", options.commands);
  if (!options.sweep_file.empty()) taken.emplace_back("--sweep-file", options.sweep_file);
  const auto claim = [&](const std::string& option, const std::string& file) {
    for (const auto& [other_option, other_file] : taken)
      if (sameFile(file, other_file)) {
        problems.add({"command line", option, file, "a file of its own; " + other_option + " names it already"});
        return;
      }
    taken.emplace_back(option, file);
  };
  for (const std::string& file : options.outputs) {
    if (!outputKind(file)) problems.add({"command line", "--output", file, "a name that ends in .csv, .bag or .lcm"});
    claim("--output", file);
  }
  if (!options.save_start.empty()) claim("--save-start", options.save_start);
  // A snapshot may replace the one the run started from: it is read before and written atomically.
  if (!options.save_snapshot.empty()) claim("--save-snapshot", options.save_snapshot);
  if (!options.load_snapshot.empty())
    for (const std::string& file : options.outputs)
      if (sameFile(file, options.load_snapshot))
        problems.add({"command line", "--output", file, "a file of its own; --load-snapshot names it already"});
}

}  // namespace

std::optional<OutputKind> outputKind(const std::string& file) {
  const std::string extension = std::filesystem::path(file).extension().string();
  if (extension == ".csv") return OutputKind::kCsv;
  if (extension == ".bag") return OutputKind::kBag;
  if (extension == ".lcm") return OutputKind::kLcm;
  return {};
}

SimulateOptions parseSimulateOptions(int argc, const char* const* argv) {
  SimulateOptions options;
  Words words;
  Problems problems;
  CLI::App app("Advances the coupled rotor system of CONFIG and records it; needs no roscore.", "simulate");
  app.allow_extras(true);  // collected and reported together with all other problems
  declare(app, options, words);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    options.help = app.help();
    return options;
  } catch (const CLI::ParseError& error) {
    problems.add({"command line", "arguments", error.get_name(), std::string("a complete command line, see --help; ") + error.what()});
    throw ConfigurationError(problems);
  }
  reportRemaining(app, problems);
  if (options.configuration.empty() && options.load_snapshot.empty() && problems.empty())
    problems.add({"command line", "CONFIG", "nothing", "a configuration file, or --load-snapshot FILE; see --help"});

  if ((options.trim || options.stability) && !options.load_snapshot.empty())
    problems.add({"command line", options.trim ? "--trim" : "--stability", "", "a start at model time 0, not --load-snapshot"});
  if (app.count("--show-coupling") > 0) options.show_coupling = words.coupling;
  options.duration = readNumber(words.duration, "--duration", "[s]", problems);
  options.revolutions = readNumber(words.revolutions, "--revolutions", "[revolutions]", problems);
  if (!words.duration.empty() && !words.revolutions.empty())
    problems.add({"command line", "--revolutions", words.revolutions, "either --duration or --revolutions, not both"});
  options.every = readCount(words.every, "--every", problems);
  options.jobs = readJobs(words.jobs, problems);
  checkSweep(options, problems);
  if (app.count("--signals") > 0) options.signals = splitSignals(words.signals, problems);
  // An option given as an empty word would otherwise silently mean its default.
  for (const char* name : {"--duration", "--revolutions", "--every", "--commands", "--save-snapshot", "--load-snapshot", "--sweep", "--sweep-file", "--jobs"})
    if (app.count(name) > 0 && app.get_option(name)->results().front().empty())
      problems.add({"command line", name, "\"\"", "a value"});
  checkFiles(options, problems);
  if (!problems.empty()) throw ConfigurationError(problems);
  return options;
}

}  // namespace heerk_rotor
