#include "files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "inkgrid/inkgrid.h"

namespace inkgrid::cli {
namespace {

namespace fs = std::filesystem;

// What a signal handler may read: the temporary file that exists at the moment, or an empty text.
char pending_temporary[PATH_MAX] = "";

[[noreturn]] void fail(const std::string& path, int error) {
  throw Error(ErrorCode::file, "can't write '" + path + "': " + std::generic_category().message(error));
}

void end_by_signal(int signal) {
  if (pending_temporary[0] != '\0') ::unlink(pending_temporary);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void write_all(int file, const std::string& text, const std::string& path) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(file, text.data() + done, text.size() - done);
    if (count < 0 && errno != EINTR) fail(path, errno);
    if (count > 0) done += static_cast<std::size_t>(count);
  }
}

// An open file that is gone when the scope is left, unless it was renamed.
class Temporary {
 public:
  explicit Temporary(const std::string& target) : target_(target) {
    const fs::path name = fs::path(target).parent_path() / (".inkgrid-" + std::to_string(::getpid()));
    if (name.native().size() >= sizeof pending_temporary) fail(target, ENAMETOOLONG);
    std::strcpy(pending_temporary, name.c_str());
    file_ = ::open(pending_temporary, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (file_ < 0) {
      pending_temporary[0] = '\0';
      fail(target, errno);
    }
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() {
    if (file_ >= 0) ::close(file_);
    if (pending_temporary[0] != '\0') ::unlink(pending_temporary);
    pending_temporary[0] = '\0';
  }

  void become_target(const std::string& text) {
    write_all(file_, text, target_);
    struct stat old {};
    if (::stat(target_.c_str(), &old) == 0) ::fchmod(file_, old.st_mode & 07777);
    const int closed = ::close(file_);
    file_ = -1;
    if (closed != 0 || ::rename(pending_temporary, target_.c_str()) != 0) fail(target_, errno);
    pending_temporary[0] = '\0';
  }

 private:
  std::string target_;
  int file_ = -1;
};

// The file behind symbolic links, so that a link stays one.
std::string behind_links(const std::string& path) {
  std::error_code failed;
  const fs::path real = fs::canonical(path, failed);
  return failed ? path : real.string();
}

// A device or pipe is written as it is: it can't be replaced by renaming.
bool is_special(const std::string& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

void write_in_place(const std::string& path, const std::string& text) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) fail(path, errno);
  try {
    write_all(file, text, path);
  } catch (...) {
    ::close(file);
    throw;
  }
  if (::close(file) != 0) fail(path, errno);
}

}  // namespace

void remove_temporary_on_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, end_by_signal);
}

void check_writable(const std::string& path) {
  if (path == "-") return;
  struct stat old {};
  const bool exists = ::stat(path.c_str(), &old) == 0;
  if (!exists && errno != ENOENT) fail(path, errno);
  if (exists && S_ISDIR(old.st_mode)) fail(path, EISDIR);
  if (exists && ::access(path.c_str(), W_OK) != 0) fail(path, errno);
  if (!is_special(path)) Temporary probe(behind_links(path));
}

void check_writable_directory(const std::string& path) {
  std::error_code failed;
  fs::path existing = fs::absolute(path, failed);
  while (!fs::exists(existing, failed) && existing.has_relative_path()) existing = existing.parent_path();
  if (!fs::is_directory(existing, failed)) fail(path, ENOTDIR);
  if (::access(existing.c_str(), W_OK | X_OK) != 0) fail(path, errno);
}

void write_file(const std::string& path, const std::string& text) {
  if (path == "-")
    write_all(STDOUT_FILENO, text, "standard output");
  else if (is_special(path))
    write_in_place(path, text);
  else
    Temporary(behind_links(path)).become_target(text);
}

}  // namespace inkgrid::cli
