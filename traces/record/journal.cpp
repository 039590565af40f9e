#include "traces/record/journal.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <optional>
#include <string>
#include <system_error>

#if __has_include(<sys/mman.h>)
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#define ZSTEP_MAPS_FILES
#endif

#include "traces/error.hpp"
#include "traces/events/slots.hpp"
#include "traces/file/container.hpp"
#include "traces/file/files.hpp"

namespace zstep {

namespace {

constexpr std::size_t memory_page = 4096, most_logs = 16;
constexpr std::array<char, 8> journal_signature{'z', 'j', 'o', 'u', 'r', 'n', '\r', '\n'};

/// How the file begins; the logs follow on the next page. It is read by the zstep that wrote it, on the same machine.
struct Head {
  std::array<char, 8> signature = journal_signature;
  std::uint64_t layout = 0;  ///< of events in memory
  std::uint64_t trace = 0;   ///< checksum of the head of the trace
  std::uint64_t logs = 0, log_size = 0;
  std::array<std::uint64_t, most_logs> block{};  ///< which each log holds
};
static_assert(sizeof(Head) <= memory_page);

/// A number that differs where events stand otherwise in memory.
std::uint64_t layout_of_events() {
  std::string text = std::to_string(trace_version);
  void (*const tell)(std::string&, std::string_view, std::ptrdiff_t) =  // one call a field
      [](std::string& all, std::string_view name, std::ptrdiff_t number) {
        all.append(name).append(" ").append(std::to_string(number));
      };
  for_each_kind([&]<class E>() {
    tell(text, description_of<E>.name, sizeof(E));
    const E event{};
    for_each_field<E>([&](const auto& field) {
      tell(text, field.name,
           reinterpret_cast<const char*>(&(event.*field.member)) - reinterpret_cast<const char*>(&event));
    });
  });
  return checksum_of({'L', 'O', 'G', 'S'}, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

std::optional<Head> head_of(InputFile& file) {
  Head head;
  file.seek(0);
  if (file.read(&head, sizeof head) != sizeof head || head.signature != journal_signature) return std::nullopt;
  return head;
}

#ifdef ZSTEP_MAPS_FILES
/// A new file with this head and room on the disk for all of its size, mapped; nullptr if that cannot be.
std::uint8_t* map_new(const std::filesystem::path& path, const Head& head, std::size_t size) {
  rlimit limit{};
  if (getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur < size)
    return nullptr;  // to ask for more would end the program
  std::error_code error;
  if (std::filesystem::exists(std::filesystem::symlink_status(path, error))) {
    try {
      InputFile old(path);
      if (!head_of(old) && old.size() > 0) return nullptr;  // not begun by a recording that was killed
    } catch (const InputError&) {
      return nullptr;
    }
    std::filesystem::remove(path, error);
  }
  const int file = open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file < 0) return nullptr;
  void* mapped = MAP_FAILED;
  const bool begun = write(file, &head, sizeof head) == static_cast<ssize_t>(sizeof head);
  if (begun && posix_fallocate(file, 0, static_cast<off_t>(size)) == 0)
    mapped = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  if (mapped != MAP_FAILED) return static_cast<std::uint8_t*>(mapped);
  unlink(path.c_str());
  return nullptr;
}
#endif

}  // namespace

std::filesystem::path journal_of(const std::filesystem::path& trace) { return trace.string() + ".journal"; }

Journal::Journal(const std::filesystem::path& trace, std::size_t logs, std::size_t log_size) : log_size_(log_size) {
#ifdef ZSTEP_MAPS_FILES
  std::error_code error;
  mapped_size_ = memory_page + logs * log_size;
  const std::filesystem::file_type type =
      trace.empty() ? std::filesystem::file_type::none : std::filesystem::status(trace, error).type();
  if (logs <= most_logs &&
      (type == std::filesystem::file_type::regular || type == std::filesystem::file_type::not_found)) {
    Head head;
    head.layout = layout_of_events(), head.logs = logs, head.log_size = log_size;
    path_ = journal_of(trace);
    mapped_ = map_new(path_, head, mapped_size_);
  }
  if (mapped_ != nullptr) {
    logs_ = mapped_ + memory_page;
    return;
  }
#endif
  own_.reset(new std::uint8_t[logs * log_size]);
  logs_ = own_.get();
}

Journal::~Journal() {
#ifdef ZSTEP_MAPS_FILES
  if (mapped_ == nullptr) return;
  munmap(mapped_, mapped_size_);
  unlink(path_.c_str());
#endif
}

void Journal::holds(const std::uint8_t* log, std::uint64_t block) {
  if (mapped_ == nullptr) return;
  const auto number = static_cast<std::size_t>(log - logs_) / log_size_;
  std::atomic_signal_fence(std::memory_order_release);
  std::memcpy(mapped_ + offsetof(Head, block) + number * sizeof block, &block, sizeof block);
}

void Journal::belongs_to(std::uint64_t head_checksum) {
  if (mapped_ != nullptr) std::memcpy(mapped_ + offsetof(Head, trace), &head_checksum, sizeof head_checksum);
}

std::vector<Bytes> logs_in_journal(const std::filesystem::path& trace, std::uint64_t head_checksum,
                                   std::uint64_t first) try {
  std::vector<Bytes> found;
  InputFile in(journal_of(trace));
  const std::optional<Head> head = head_of(in);
  if (!head || head->layout != layout_of_events() || head->trace != head_checksum || head->logs > most_logs)
    return found;
  const std::uint64_t size = in.size();
  if (size < memory_page) return found;
  if (head->log_size > (size - memory_page) / std::max<std::uint64_t>(head->logs, 1)) return found;
  const std::size_t log_size = head->log_size;
  if (log_size != head->log_size) return found;  // more than there is memory to address
  for (std::uint64_t block = first; found.size() < head->logs; ++block) {
    const std::size_t number =
        std::find(head->block.begin(), head->block.begin() + head->logs, block) - head->block.begin();
    if (number == head->logs) break;
    Bytes log(log_size);
    in.seek(memory_page + std::uint64_t{number} * log_size);
    if (in.read(log.data(), log.size()) != log.size()) break;
    // Of a recording that goes on: it may have been another block's meanwhile.
    const std::optional<Head> now = head_of(in);
    if (!now || now->block[number] != block) break;
    found.push_back(std::move(log));
  }
  return found;
} catch (const InputError&) {
  return {};  // there is none, or it is something else
}

}  // namespace zstep
