// Checkpoint files: they hold what was saved, stay whole whatever happens, and damage is told.
#include <fcntl.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "base/error.hpp"
#include "output/checkpoint.hpp"
#include "output/descriptor.hpp"
#include "support/file_error.hpp"

namespace {

using namespace cinch;
using test::file_error_of;
namespace fs = std::filesystem;

struct Scratch {
  fs::path path = fs::temp_directory_path() / ("cinch_checkpoint_" + std::to_string(getpid()));
  Scratch() { fs::create_directories(path); }
  ~Scratch() { fs::remove_all(path); }
  fs::path file() const { return path / "checkpoint.h5"; }
};

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void put(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

void write(const fs::path& file, double mark) {
  CheckpointWriter out(file);
  std::vector<double> numbers{mark, 0.1, -0.0, 5e-324};
  std::vector<std::int64_t> wholes{-1, 1LL << 62};
  std::vector<std::string> words{"one", "two \"three\"\n", ""};
  std::vector<double> none;
  bool yes = true;
  out.list("a/numbers", numbers);
  out.list("a/wholes", wholes);
  out.texts("words", words);
  out.list("none", none);
  out.flag("yes", yes);
  out.commit();
}

std::string complaint(const fs::path& path) {
  return file_error_of([&] { CheckpointReader reader(path); });
}

TEST(Checkpoint, ComesBackToTheBit) {
  const Scratch scratch;
  write(scratch.file(), 7);
  for (const fs::path& path : {scratch.file(), scratch.path}) {  // the file, or the folder it lies in
    CheckpointReader in(path);
    EXPECT_EQ(in.path(), scratch.file());
    std::vector<double> numbers, none{1};
    std::vector<std::int64_t> wholes;
    std::vector<std::string> words;
    bool yes = false;
    in.list("a/numbers", numbers);
    in.list("a/wholes", wholes);
    in.texts("words", words);
    in.list("none", none);
    in.flag("yes", yes);
    EXPECT_EQ(numbers, (std::vector<double>{7, 0.1, -0.0, 5e-324}));
    EXPECT_TRUE(std::signbit(numbers[2]));
    EXPECT_EQ(wholes, (std::vector<std::int64_t>{-1, 1LL << 62}));
    EXPECT_EQ(words, (std::vector<std::string>{"one", "two \"three\"\n", ""}));
    EXPECT_TRUE(none.empty());
    EXPECT_TRUE(yes);
  }
}

TEST(Checkpoint, BeginsWithATextForPeople) {
  const Scratch scratch;
  write(scratch.file(), 7);
  const std::string text = bytes_of(scratch.file());
  EXPECT_EQ(text.substr(0, 29),
            "cinch checkpoint 1\nbytes  = " + std::to_string(text.size() - 512).substr(0, 1));
  EXPECT_EQ(text.substr(512, 4), "\x89HDF");
}

TEST(Checkpoint, AnAbandonedOneLeavesTheOneBefore) {
  const Scratch scratch;
  write(scratch.file(), 7);
  const std::string before = bytes_of(scratch.file());
  {
    CheckpointWriter out(scratch.file());
    double number = 8;
    out.value("a/number", number);
  }
  EXPECT_EQ(bytes_of(scratch.file()), before);
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch.path), {}), 1) << "the draft is gone";
  write(scratch.file(), 9);
  EXPECT_NE(bytes_of(scratch.file()), before);
}

TEST(Checkpoint, EveryDamagedByteIsSeen) {
  const Scratch scratch;
  write(scratch.file(), 7);
  const std::string whole = bytes_of(scratch.file());
  std::mt19937 random(5);
  for (int round = 0; round < 300; ++round) {
    std::string damaged = whole;
    const std::size_t at = round < 64 ? static_cast<std::size_t>(round) : random() % damaged.size();
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << (round % 8)));
    put(scratch.file(), damaged);
    EXPECT_NE(complaint(scratch.file()), "") << "byte " << at;
  }
  for (const std::size_t length :
       {whole.size() - 1, whole.size() / 2, std::size_t{512}, std::size_t{100}, std::size_t{0}}) {
    put(scratch.file(), whole.substr(0, length));
    EXPECT_NE(complaint(scratch.file()), "") << length << " bytes";
  }
  put(scratch.file(), whole + "x");
  EXPECT_NE(complaint(scratch.file()), "");
  put(scratch.file(), whole);
  EXPECT_EQ(complaint(scratch.file()), "");
}

TEST(Checkpoint, WhatIsNoneIsToldApart) {
  const Scratch scratch;
  EXPECT_EQ(complaint(scratch.path / "nowhere"),
            "error: " + (scratch.path / "nowhere").string() + ": no such file or directory");
  EXPECT_EQ(complaint(scratch.path),
            "error: " + scratch.path.string() + ": no checkpoint.h5 in this directory");
  put(scratch.file(), std::string(2000, 'x'));
  EXPECT_EQ(complaint(scratch.file()), "error: " + scratch.file().string() + ": not a checkpoint of cinch");
  write(scratch.file(), 7);
  std::string other = bytes_of(scratch.file());
  other[17] = '2';
  put(scratch.file(), other);
  EXPECT_EQ(complaint(scratch.file()), "error: " + scratch.file().string() +
                                           ": a checkpoint of another format; this program reads format 1");
  write(scratch.file(), 7);
  other = bytes_of(scratch.file());
  other[700] = static_cast<char>(~other[700]);
  put(scratch.file(), other);
  EXPECT_NE(complaint(scratch.file()).find("damaged"), std::string::npos) << complaint(scratch.file());
}

TEST(Checkpoint, FieldsThatDoNotFitAreNamed) {
  const Scratch scratch;
  write(scratch.file(), 7);
  CheckpointReader in(scratch.file());
  double one = 0;
  std::int64_t number = 0;
  std::vector<std::string> words;
  const std::string file = "error: " + scratch.file().string() + ": ";
  EXPECT_EQ(file_error_of([&] { in.value("a/numbers", one); }),
            file + "a/numbers has 4 values; the case needs 1");
  EXPECT_EQ(file_error_of([&] { in.value("a/other", one); }), file + "a/other is missing");
  EXPECT_EQ(file_error_of([&] { in.whole("yes", number, 2, 9); }), file + "yes holds 1; allowed: 2 to 9");
  EXPECT_NE(file_error_of([&] { in.texts("a/numbers", words); }), "");
  EXPECT_NE(file_error_of([&] { in.value("words", one); }), "");
}

TEST(Descriptor, TellsTheSystemsReason) {
  std::vector<std::uint8_t> bytes(10);
  EXPECT_EQ(file_error_of([&] { Descriptor("/dev/full", O_WRONLY).write_at(0, bytes); }),
            "error: /dev/full: cannot write it: No space left on device");
  EXPECT_EQ(file_error_of([&] { Descriptor("/", O_RDONLY | O_DIRECTORY).read_at(0, bytes); }),
            "error: /: cannot read it: Is a directory");
  EXPECT_EQ(file_error_of([&] { Descriptor("/dev/full", O_WRONLY).sync(); }),
            "error: /dev/full: cannot write it: Invalid argument");
}

TEST(Checkpoint, APlaceThatCannotBeWrittenIsNamed) {
  const Scratch scratch;
  put(scratch.path / "file", "");
  try {
    CheckpointWriter out(scratch.path / "file" / "checkpoint.h5");
    FAIL() << "opened";
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("file/checkpoint.h5.tmp"), std::string::npos) << error.what();
  }
}

}  // namespace
