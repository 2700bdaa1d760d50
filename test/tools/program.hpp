#pragma once
#include <cerrno>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "test_files.hpp"

extern char** environ;

namespace heerk_rotor {

/// The built program `simulate`, started with its own standard streams.
class Program {
 public:
  explicit Program(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), std::string(HEERK_PROGRAM_DIR) + "/simulate");
    std::vector<char*> words;
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, folder_.file("out").c_str(), O_WRONLY | O_CREAT, 0600);
    posix_spawn_file_actions_addopen(&actions, 2, folder_.file("err").c_str(), O_WRONLY | O_CREAT, 0600);
    const int error = ::posix_spawn(&process_, words[0], &actions, nullptr, words.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) throw std::runtime_error(arguments[0] + " cannot be started");
  }

  pid_t process() const { return process_; }

  /// Exit status of the ended program, or -signal when a signal killed it.
  int wait() {
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0)
      if (errno != EINTR) throw std::runtime_error("waitpid failed");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  /// Processor time it has spent so far [s].
  double cpuTime() const {
    clockid_t clock;
    timespec spent{};
    if (::clock_getcpuclockid(process_, &clock) != 0 || ::clock_gettime(clock, &spent) != 0) throw std::runtime_error("no processor time of the program");
    return static_cast<double>(spent.tv_sec) + 1e-9 * static_cast<double>(spent.tv_nsec);
  }

  /// Waits until `reached()`, however slow the machine is: while the program runs and has not spent ten seconds of processor time on its way there.
  template <class Condition>
  bool computesUntil(const Condition& reached) const {
    const double limit = cpuTime() + 10.0;
    while (!reached()) {
      siginfo_t ended{};
      if (::waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 || ended.si_pid != 0 || cpuTime() > limit) return false;
      ::usleep(1000);
    }
    return true;
  }

  std::string out() const { return readText(folder_.file("out")); }
  std::string err() const { return readText(folder_.file("err")); }

 private:
  TestFolder folder_;
  pid_t process_ = 0;
};

struct Finished {
  int status;
  std::string out, err;
};

inline Finished simulate(const std::vector<std::string>& arguments) {
  Program program(arguments);
  const int status = program.wait();
  return {status, program.out(), program.err()};
}

inline std::string shippedConfiguration(const std::string& name) { return std::string(HEERK_SOURCE_DIR) + "/config/" + name; }

}  // namespace heerk_rotor
