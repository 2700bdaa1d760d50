#pragma once
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

namespace heerk_rotor {

/// Runs `work` in a process of its own, which ends with this object or with the test at the latest.
class ChildProcess {
 public:
  explicit ChildProcess(const std::function<void()>& work) {
    pid_ = fork();
    if (pid_ > 0) setpgid(pid_, pid_);
    if (pid_ != 0) return;
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    work();
    _exit(127);
  }
  ~ChildProcess() {
    if (pid_ <= 0) return;
    kill(-pid_, SIGKILL);  // with what it has started itself
    waitpid(pid_, nullptr, 0);
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  bool running() {
    poll();
    return pid_ > 0;
  }
  void interrupt() {
    if (running()) kill(pid_, SIGINT);
  }
  /// Exit status; negative: signal. Meaningful when it does not run any more.
  int status() const { return status_; }

 private:
  void poll() {
    int status = 0;
    if (pid_ <= 0 || waitpid(pid_, &status, WNOHANG) != pid_) return;
    pid_ = 0;
    status_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  pid_t pid_ = 0;
  int status_ = 0;
};

}  // namespace heerk_rotor
