#include "heerk_rotor/assembly/file_replacement.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace heerk_rotor {
namespace {

/// A new file beside `target` that is removed again unless it took the target's name.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& target) : target_(target) {
    static std::atomic<unsigned> counter{0};  // threads may write the same target at the same time
    do {
      name_ = target + ".part-" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
      descriptor_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor_ < 0 && errno == EEXIST);  // left by a killed process of the same number
    if (descriptor_ < 0) fail("cannot be created", errno);
  }
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!renamed_) ::unlink(name_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(const std::string& contents) {
    for (std::size_t done = 0; done < contents.size();) {
      const ssize_t written = ::write(descriptor_, contents.data() + done, contents.size() - done);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail("cannot be written", errno);
      done += static_cast<std::size_t>(written);
    }
    if (::fsync(descriptor_) != 0) fail("cannot be flushed to the disk", errno);
    const int closed = ::close(descriptor_);  // some file systems report a full disk only here
    descriptor_ = -1;
    if (closed != 0) fail("cannot be closed", errno);
  }
  void takeName() {
    if (::rename(name_.c_str(), target_.c_str()) != 0) fail("cannot take its name", errno);
    renamed_ = true;
  }

 private:
  [[noreturn]] void fail(const std::string& what, int error) const {
    throw std::runtime_error(target_ + " cannot be saved: the temporary file " + name_ + " " + what + " (" + std::strerror(error) + ")");
  }
  std::string target_, name_;
  int descriptor_ = -1;
  bool renamed_ = false;
};

}  // namespace

void replaceFile(const std::string& file, const std::string& contents) {
  std::filesystem::path directory = std::filesystem::path(file).parent_path();
  if (directory.empty()) directory = ".";
  std::error_code error;
  if (!std::filesystem::is_directory(directory, error)) throw std::runtime_error(file + " cannot be saved: there is no directory " + directory.string());
  if (std::filesystem::is_directory(file, error)) throw std::runtime_error(file + " cannot be saved: it is a directory");

  TemporaryFile temporary(file);
  temporary.write(contents);
  temporary.takeName();

  // The new name is an entry of the directory. Where a file system cannot flush those, the contents are safe all the same.
  const int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor >= 0) {
    ::fsync(descriptor);
    ::close(descriptor);
  }
}

}  // namespace heerk_rotor
