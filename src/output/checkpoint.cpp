#include "output/checkpoint.hpp"

#include <fcntl.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <optional>

#include "base/error.hpp"
#include "base/fnv.hpp"
#include "output/descriptor.hpp"
#include "output/hdf5_file.hpp"
#include "output/result_layout.hpp"

namespace cinch {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t block_bytes = 512;
constexpr char block_form[] = "cinch checkpoint 1\nbytes  = %llu\nfnv1a  = %016llx\n";

using Block = std::array<std::uint8_t, block_bytes>;

// What the block has to say about the bytes behind it as they are.
Block describe(const Descriptor& file) {
  std::vector<std::uint8_t> piece(1 << 20);
  Fnv hash;
  std::size_t place = block_bytes;
  while (const std::size_t got = file.read_at(place, piece)) {
    for (std::size_t i = 0; i < got; ++i) hash.add(piece[i]);
    place += got;
  }
  char text[block_bytes] = "";
  std::snprintf(text, sizeof text, block_form, static_cast<unsigned long long>(place - block_bytes),
                static_cast<unsigned long long>(hash.hash()));
  Block block{};
  std::memcpy(block.data(), text, sizeof text);
  return block;
}

// Of a result without checkpoint: what is likely, and what to do.
std::string why_none() {
  return ", but a result: its run is still running, or stopped before it wrote one (killed, or the disk was "
         "full; one is written once a minute by default, and when the run ends or is stopped by Ctrl-C or "
         "SIGTERM), or has output.checkpoint = false\n    run the case anew; "
         "--set output.checkpoint_run_time_s=10 writes one every ten seconds";
}

fs::path find_checkpoint(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) throw FileError("error: " + path.string() + ": no such file or directory");
  if (!fs::is_directory(path, error)) return path;
  if (!fs::exists(path / layout::kCheckpointFile, error))
    throw FileError("error: " + path.string() + ": no " + layout::kCheckpointFile + " in this directory" +
                    (fs::exists(path / layout::kResultFile, error) ? why_none() : ""));
  return path / layout::kCheckpointFile;
}

void require_whole(const fs::path& path) {
  const Descriptor file(path, O_RDONLY);
  Block block{};
  const bool full = file.read_at(0, block) == block.size();
  const auto said = [&](std::size_t letters) { return std::memcmp(block.data(), block_form, letters) == 0; };
  if (!full || !said(std::strlen("cinch checkpoint ")))
    throw FileError("error: " + path.string() + ": not a checkpoint of cinch");
  if (!said(std::strlen("cinch checkpoint 1\n")))
    throw FileError("error: " + path.string() +
                    ": a checkpoint of another format; this program reads format 1");
  if (describe(file) != block)
    throw FileError("error: " + path.string() +
                    ": the checkpoint is damaged: its bytes are not those that were written");
}

}  // namespace

struct CheckpointWriter::Impl {
  fs::path path, draft;
  std::optional<h5::File> file;
};

CheckpointWriter::CheckpointWriter(fs::path path) : impl_(std::make_unique<Impl>()) {
  impl_->path = std::move(path);
  impl_->draft = impl_->path.string() + ".tmp";
  impl_->file.emplace(h5::File::create(impl_->draft, block_bytes));
}

CheckpointWriter::~CheckpointWriter() {
  if (impl_->draft.empty()) return;
  impl_->file.reset();
  std::error_code ignored;
  fs::remove(impl_->draft, ignored);
}

void CheckpointWriter::commit() {
  impl_->file->flush();
  impl_->file.reset();
  {
    const Descriptor file(impl_->draft, O_RDWR);
    file.write_at(0, describe(file));
    file.sync();
  }
  std::error_code error;
  fs::rename(impl_->draft, impl_->path, error);
  if (error) throw FileError(impl_->path.string() + ": cannot replace it: " + error.message());
  impl_->draft.clear();
  const fs::path folder = impl_->path.parent_path();
  Descriptor(folder.empty() ? fs::path(".") : folder, O_RDONLY | O_DIRECTORY).sync();
}

void CheckpointWriter::values(const std::string& name, std::span<double> numbers) {
  impl_->file->write<double>("/" + name, numbers, {numbers.size()});
}

void CheckpointWriter::values(const std::string& name, std::span<std::int64_t> numbers) {
  impl_->file->write<std::int64_t>("/" + name, numbers, {numbers.size()});
}

void CheckpointWriter::texts(const std::string& name, std::vector<std::string>& list) {
  impl_->file->write_texts("/" + name, list);
}

std::string CheckpointWriter::place() const { return impl_->path.string(); }

struct CheckpointReader::Impl {
  h5::File file;
  std::uintmax_t bytes;
};

CheckpointReader::CheckpointReader(const fs::path& path) {
  const fs::path file = find_checkpoint(path);
  require_whole(file);
  impl_ = std::make_unique<Impl>(Impl{h5::File::open(file), fs::file_size(file)});
}

CheckpointReader::~CheckpointReader() = default;
const fs::path& CheckpointReader::path() const { return impl_->file.path(); }

std::size_t CheckpointReader::length(const std::string& name, std::size_t) {
  if (!holds(name)) refuse(name, "is missing");
  const h5::Shape shape = impl_->file.shape("/" + name);
  // each entry takes eight bytes or more; what promises more would exhaust the memory
  if (shape.size() != 1 || shape[0] > impl_->bytes / sizeof(double))
    refuse(name, "is no list, or longer than the file");
  return shape[0];
}

template <class Number>
void CheckpointReader::read(const std::string& name, std::span<Number> numbers) {
  if (const std::size_t there = length(name, 0); there != numbers.size())
    refuse(name,
           "has " + std::to_string(there) + " values; the case needs " + std::to_string(numbers.size()));
  impl_->file.read_rows<Number>("/" + name, 0, numbers.size(), numbers);
}

void CheckpointReader::values(const std::string& name, std::span<double> numbers) { read(name, numbers); }
void CheckpointReader::values(const std::string& name, std::span<std::int64_t> numbers) {
  read(name, numbers);
}

void CheckpointReader::texts(const std::string& name, std::vector<std::string>& list) {
  length(name, 0);
  list = impl_->file.read_texts("/" + name);
}

bool CheckpointReader::holds(const std::string& name) const { return impl_->file.exists("/" + name); }
std::string CheckpointReader::place() const { return path().string(); }

}  // namespace cinch
