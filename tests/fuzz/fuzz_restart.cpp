// Fuzz target of the restart: what simulations have saved, with entries spoilt as the input says, is refused
// by one clear error or gives a simulation that can be stepped and looked at; see tests/fuzz/run.
#include <fuzzer/FuzzedDataProvider.h>

#include <cstdio>
#include <cstdlib>
#include <map>

#include "base/error.hpp"
#include "plan/simulation.hpp"
#include "support/memory_archive.hpp"
#include "support/quick_cases.hpp"

namespace {

using namespace cinch;
using namespace cinch::test;

struct Saved {
  Scene scene;
  Entries entries;
};

// In the midst of contacts, of sliding, and of forces that hold.
const std::vector<Saved>& saved() {
  static const std::vector<Saved> list = [] {
    std::vector<Saved> made;
    for (const auto& [one, step] :
         {std::pair{ring_pull(), 200}, {capture(), 300}, {sliding_capture(), 300}, {held_capture(), 301}}) {
      Simulation simulation(read(one), 1);
      simulation.advance_to(step);
      MemoryArchive archive;
      simulation.save(archive);
      made.push_back({read(one), archive.entries});
    }
    return made;
  }();
  return list;
}

template <class Value>
Value next_value(FuzzedDataProvider& input) {
  if constexpr (std::is_same_v<Value, double>) return input.ConsumeFloatingPoint<double>();
  else if constexpr (std::is_same_v<Value, std::int64_t>)
    return input.ConsumeBool() ? input.ConsumeIntegralInRange<std::int64_t>(-3, 300)
                               : input.ConsumeIntegral<std::int64_t>();
  else return input.ConsumeRandomLengthString(40);
}

void spoil(Entry& entry, FuzzedDataProvider& input) {
  std::visit(
      [&](auto& values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        const int way = input.ConsumeIntegralInRange(0, 9);
        if (values.empty() || way == 0) values.push_back(next_value<Value>(input));
        else if (way == 1) values.pop_back();
        else
          values[input.ConsumeIntegralInRange<std::size_t>(0, values.size() - 1)] = next_value<Value>(input);
      },
      entry);
}

void go_on(const Scene& scene, const Entries& entries) {
  MemoryArchive archive(entries);
  Simulation simulation(scene, prepare(scene), 1, archive);
  simulation.advance_to(simulation.step() + 4);
  simulation.note_events(simulation.look());
  simulation.frame();
  simulation.summary();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider input(data, size);
  const Saved& one = saved()[input.ConsumeIntegralInRange<std::size_t>(0, saved().size() - 1)];
  Entries entries = one.entries;
  for (int k = 0; k < 8 && input.remaining_bytes() > 0; ++k) {
    auto victim = entries.begin();
    std::advance(victim, input.ConsumeIntegralInRange<std::size_t>(0, entries.size() - 1));
    spoil(victim->second, input);
  }
  try {
    go_on(one.scene, entries);
  } catch (const NumericalError&) {  // the motion that was restored is none to go on from
  } catch (const FileError& error) {
    if (std::string(error.what()).find("error: memory: ") == 0) return 0;
    std::fprintf(stderr, "an error that does not say what is wrong:\n%s\n", error.what());
    std::abort();
  }
  return 0;
}
