#include "heerk_rotor/tools/run_sweep.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include <sched.h>
#include <time.h>

#include "heerk_rotor/tools/conclude_run.hpp"
#include "heerk_rotor/tools/row_file.hpp"
#include "heerk_rotor/tools/stop_request.hpp"

namespace heerk_rotor {
namespace {

constexpr std::chrono::milliseconds kRedraw(100);

/// Lines that are finished, until those before them are.
struct FinishedLines {
  std::mutex mutex;
  std::condition_variable changed;
  std::map<std::uint64_t, std::string> lines;  // run -> line
  std::uint64_t done = 0, failed = 0;          // runs so far
  std::size_t working = 0;                     // threads that may still bring lines
  std::string first_failure;
  std::uint64_t first_failed = ~std::uint64_t(0);
};

void take(FinishedLines& finished, std::uint64_t run, const SweepOutcome& outcome, std::string line) {
  const std::lock_guard<std::mutex> lock(finished.mutex);
  finished.lines.emplace(run, std::move(line));
  finished.changed.notify_one();
  ++finished.done;
  if (outcome.status == "done" || outcome.status == "interrupted") return;
  ++finished.failed;
  if (run > finished.first_failed) return;
  finished.first_failed = run;
  finished.first_failure = outcome.status + ": " + outcome.message;
}

/// The lines that can be written now, in order.
std::string nextLines(FinishedLines& finished, std::uint64_t& next) {
  std::string text;
  for (auto first = finished.lines.begin(); first != finished.lines.end() && first->first == next; first = finished.lines.erase(first), ++next) text += first->second;
  return text;
}

RowFile openTable(const std::string& file) {
  try {
    return RowFile(file, 0);
  } catch (const std::runtime_error& error) {
    Problems problems;
    problems.add({"command line", "--output", file, std::string("a file that can be written (") + error.what() + ")"});
    throw ConfigurationError(problems);
  }
}

/// Those this process may run on (taskset, containers), not those of the machine.
std::size_t processors() {
  cpu_set_t allowed;
  if (::sched_getaffinity(0, sizeof allowed, &allowed) == 0) return static_cast<std::size_t>(CPU_COUNT(&allowed));
  return std::max(1u, std::thread::hardware_concurrency());  // more processors than cpu_set_t holds
}

struct SweepTotals {
  std::uint64_t runs, done, failed;
  std::size_t jobs;
  double wall_time;  // [s]
  double cpu_time;   // of all threads [s]
};

double processSeconds() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string text(const SweepTotals& t) {
  char buffer[256];
  const auto number = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
  std::snprintf(buffer, sizeof buffer, "sweep: %llu of %llu runs in %.4g s by %zu job%s, %llu failed\n", number(t.done), number(t.runs), t.wall_time, t.jobs, t.jobs == 1 ? "" : "s", number(t.failed));
  return buffer;
}

std::string json(const SweepTotals& t, const std::string& status) {
  char buffer[256];
  const auto number = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
  std::snprintf(buffer, sizeof buffer, "{\"runs\": %llu, \"done\": %llu, \"failed\": %llu, \"jobs\": %zu, \"wall_time\": %.17g, \"cpu_time\": %.17g, \"status\": \"%s\"}\n", number(t.runs), number(t.done), number(t.failed),
                t.jobs, t.wall_time, t.cpu_time, status.c_str());
  return buffer;
}

void complain(const std::string& message) { std::fprintf(stderr, "simulate: %s\n", message.c_str()); }

}  // namespace

int runSweep(const SimulateOptions& options) {
  // Everything that can be wrong with the sweep as a whole shows here, before the file is touched.
  const Sweep sweep = readSweep(options);
  const SweepColumns columns = checkSweep(options, sweep);
  const SweepTable table(sweep, columns.units, columns.signals);
  RowFile file = openTable(options.outputs.front());
  if (!options.quiet)
    for (const std::string& warning : columns.warnings) complain("warning: first run: " + warning);
  file.write(table.header());

  const std::size_t jobs = static_cast<std::size_t>(std::min<std::uint64_t>(options.jobs.value_or(processors()), sweep.size()));
  const StopRequest stop;
  const auto start = std::chrono::steady_clock::now();
  const double cpu_start = processSeconds();
  SweepProgress progress(sweep.size(), !options.quiet);
  FinishedLines finished;
  finished.working = jobs;
  std::atomic<std::uint64_t> next_run{0};
  std::atomic<bool> file_failed{false};

  const auto work = [&] {
    for (std::uint64_t run; !file_failed && StopRequest::signal() == 0 && (run = next_run.fetch_add(1)) < sweep.size();) {
      const SweepOutcome outcome = runOne(options, sweep, run, columns.signals, progress);
      take(finished, run, outcome, table.row(run, outcome));
    }
    const std::lock_guard<std::mutex> lock(finished.mutex);
    --finished.working;
    finished.changed.notify_one();
  };
  std::vector<std::thread> workers;
  for (std::size_t i = 0; i < jobs; ++i) workers.emplace_back(work);

  // This thread writes and shows.
  std::uint64_t next_line = 0;
  for (bool working = true; working;) {
    std::unique_lock<std::mutex> lock(finished.mutex);
    finished.changed.wait_for(lock, kRedraw, [&] { return finished.working == 0 || finished.lines.count(next_line) > 0; });
    working = finished.working > 0;
    const std::string lines = nextLines(finished, next_line);
    const std::uint64_t done = finished.done;
    lock.unlock();
    if (!lines.empty()) file.write(lines);
    if (file.error() != 0) file_failed = true;
    progress.update(done);
  }
  for (std::thread& worker : workers) worker.join();
  progress.finish();

  const double wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const SweepTotals totals = {sweep.size(), finished.done, finished.failed, jobs, wall_time, processSeconds() - cpu_start};
  const bool complete = file.close();
  if (!complete) complain(options.outputs.front() + ": writing failed (" + std::strerror(file.error()) + "); the rows before are complete");
  if (finished.failed > 0) complain("run " + std::to_string(finished.first_failed) + " failed first; " + finished.first_failure);
  const RunStatus status = !complete ? RunStatus::kOutputFailed : StopRequest::signal() != 0 ? RunStatus::kInterrupted : RunStatus::kDone;
  const std::string report = options.json ? json(totals, name(status)) : options.quiet ? "" : text(totals);
  const bool printed = std::fputs(report.c_str(), stdout) >= 0 && std::fflush(stdout) == 0;
  if (status == RunStatus::kDone && finished.failed > 0) return 3;
  return !printed && status == RunStatus::kDone ? 1 : exitStatus(status, StopRequest::signal());
}

}  // namespace heerk_rotor
