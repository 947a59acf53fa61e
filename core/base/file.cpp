#include "base/file.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace sward::base {
namespace {

namespace fs = std::filesystem;

Error ioError(const std::string& what, const fs::path& path, int code) {
  std::string remedy;
  switch (code) {
    case ENOENT:
    case ENOTDIR:
      remedy = "Check the path, or create the folder first.";
      break;
    case EACCES:
    case EPERM:
    case EROFS:
      remedy = "Choose a place that you may write to, or change its permissions.";
      break;
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      remedy = "Free some space on that disk, or choose another.";
      break;
    case EISDIR:
      remedy = "Give the name of a file.";
      break;
    default:
      break;
  }
  const bool users = code == ENOENT || code == EISDIR || code == ENOTDIR;
  return {users ? ErrorKind::BadInput : ErrorKind::Failed, what + ": " + std::strerror(code), path.string(), remedy};
}

/// Writes everything or says why not; a short write is retried.
int writeAll(int fd, const std::byte* data, std::size_t size) {
  while (size > 0) {
    const ssize_t done = ::write(fd, data, size);
    if (done < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    data += done;
    size -= static_cast<std::size_t>(done);
  }
  return 0;
}

fs::path temporaryBeside(const fs::path& path) {
  static std::atomic<unsigned> counter{0};
  std::string text = ".";
  text += path.stem().string();
  text += ".tmp" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
  fs::path name = text;
  name += path.extension();
  return path.parent_path() / name;
}

}  // namespace

Result<std::vector<std::byte>> readFile(const fs::path& path, std::uint64_t limitBytes) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return ioError("cannot open the file", path, errno);
  struct stat info {};
  if (::fstat(fd, &info) != 0 || S_ISDIR(info.st_mode)) {
    const int code = S_ISDIR(info.st_mode) ? EISDIR : errno;
    ::close(fd);
    return ioError("cannot read the file", path, code);
  }
  std::vector<std::byte> data;
  data.resize(
      static_cast<std::size_t>(std::min<std::uint64_t>(static_cast<std::uint64_t>(info.st_size), limitBytes) + 1));
  std::size_t used = 0;
  while (true) {
    if (used == data.size()) data.resize(std::max<std::size_t>(data.size() * 2, 4096));
    const ssize_t got = ::read(fd, data.data() + used, data.size() - used);
    if (got < 0) {
      if (errno == EINTR) continue;
      const int code = errno;
      ::close(fd);
      return ioError("cannot read the file", path, code);
    }
    if (got == 0) break;
    used += static_cast<std::size_t>(got);
    if (used > limitBytes) {
      ::close(fd);
      return Error::badInput("the file is larger than " + std::to_string(limitBytes >> 20) + " MiB", path.string(),
                             "Use a smaller file.");
    }
  }
  ::close(fd);
  data.resize(used);
  return data;
}

Result<std::string> readTextFile(const fs::path& path, std::uint64_t limitBytes) {
  SWARD_ASSIGN(const std::vector<std::byte> data, readFile(path, limitBytes));
  return std::string(reinterpret_cast<const char*>(data.data()), data.size());
}

Result<void> writeThroughTemporary(const fs::path& named, const std::function<Result<void>(const fs::path&)>& write) {
  std::error_code code;
  // rename(2) would put a file in the place of a symbolic link.
  fs::path path = fs::is_symlink(named, code) ? fs::weakly_canonical(named, code) : named;
  if (code) path = named;
  if (fs::is_directory(path, code)) return ioError("cannot write the file", path, EISDIR);
  const fs::path temporary = temporaryBeside(path);
  Result<void> written = write(temporary);
  if (written.ok()) {
    // rename(2) replaces a read-only target whose folder is writable: a user who protected a file does not expect that.
    struct stat old {};
    if (::stat(path.c_str(), &old) == 0) {
      if (::access(path.c_str(), W_OK) != 0) written = ioError("cannot write the file", path, errno);
      // A file system without permissions refuses this, and loses nothing by it.
      ::chmod(temporary.c_str(), old.st_mode & 07777);
    }
  }
  if (written.ok() && ::rename(temporary.c_str(), path.c_str()) != 0) {
    written = ioError("cannot write the file", path, errno);
  }
  if (!written.ok()) ::unlink(temporary.c_str());
  return written;
}

Result<void> writeFileAtomically(const fs::path& path, std::span<const std::byte> data, Sync sync) {
  return writeThroughTemporary(path, [&](const fs::path& temporary) -> Result<void> {
    const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (fd < 0) return ioError("cannot write the file", path, errno);
    int failure = writeAll(fd, data.data(), data.size());
    if (failure == 0 && sync == Sync::Yes && ::fsync(fd) != 0 && errno != EINVAL) failure = errno;
    if (::close(fd) != 0 && failure == 0) failure = errno;
    if (failure != 0) return ioError("cannot write the file", path, failure);
    return {};
  });
}

Result<void> writeFileAtomically(const fs::path& path, const std::string& text, Sync sync) {
  return writeFileAtomically(path, std::as_bytes(std::span(text)), sync);
}

}  // namespace sward::base
