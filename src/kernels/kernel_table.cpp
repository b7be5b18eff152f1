#include "kernels/kernel_table.hpp"

#include <cstdlib>
#include <cstring>
#include <string>

#include "base/error.hpp"

namespace cinch {

#define CINCH_DECLARE_ISA(isa)                 \
  namespace isa {                              \
  void fill_axial(KernelTable& table);         \
  void fill_ring_contact(KernelTable& table);  \
  void fill_ball_contact(KernelTable& table);  \
  void fill_sliding_joint(KernelTable& table); \
  void fill_ring_body(KernelTable& table);     \
  void fill_node_update(KernelTable& table);   \
  void fill_energy(KernelTable& table);        \
  void fill_free_flight(KernelTable& table);   \
  void fill(KernelTable& table) {              \
    fill_axial(table);                         \
    fill_ring_contact(table);                  \
    fill_ball_contact(table);                  \
    fill_sliding_joint(table);                 \
    fill_ring_body(table);                     \
    fill_node_update(table);                   \
    fill_energy(table);                        \
    fill_free_flight(table);                   \
  }                                            \
  }
CINCH_DECLARE_ISA(base)
#ifdef CINCH_X86_ISAS
CINCH_DECLARE_ISA(v3)
CINCH_DECLARE_ISA(v4)
namespace v4 {
void fill_chain(KernelTable& table);
}
#endif

namespace {

KernelTable make_table(const char* isa, void (*fill)(KernelTable&)) {
  KernelTable table{};
  table.isa = isa;
  fill(table);
  return table;
}

KernelTable choose() {
  const char* const wanted = std::getenv("CINCH_ISA");
  const auto allowed = [&](const char* name) { return wanted == nullptr || std::strcmp(wanted, name) == 0; };
#ifdef CINCH_X86_ISAS
  const bool v3_here = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool v4_here = v3_here && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                       __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
  if (v4_here && allowed("v4")) {
    KernelTable table = make_table("v4", v4::fill);
    v4::fill_chain(table);
    return table;
  }
  if (v3_here && allowed("v3")) return make_table("v3", v3::fill);
#endif
  if (!allowed("base"))
    throw CaseError(std::string("error: CINCH_ISA=") + wanted +
                    ": allowed on this machine are base, v3, v4 as far as it "
                    "has them");
  return make_table("base", base::fill);
}

}  // namespace

const KernelTable& kernels() {
  static const KernelTable table = choose();
  return table;
}

}  // namespace cinch
