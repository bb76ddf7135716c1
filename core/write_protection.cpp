#include "core/write_protection.h"

#include <unistd.h>

#include <string>
#include <utility>

namespace bosquet {

Result<void> check_replaceable(const std::filesystem::path& target) {
  std::error_code ec;
  const std::filesystem::file_status there = std::filesystem::status(target, ec);
  if (ec || there.type() != std::filesystem::file_type::regular) return {};
  using std::filesystem::perms;
  // The administrator may write whatever he likes; a mark that nobody shall is kept all the same.
  const bool nobody =
      (there.permissions() & (perms::owner_write | perms::group_write | perms::others_write)) == perms::none;
  if (!nobody && ::access(target.c_str(), W_OK) == 0) return {};
  std::string message("cannot write ");
  message.append(target.string()).append(": it is read-only; make it writable or take another name");
  return Error{std::move(message)};
}

}  // namespace bosquet
