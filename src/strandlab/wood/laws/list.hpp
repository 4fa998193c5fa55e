// The laws of yielding there are. A law is a header and a source file of this folder and its line below:
//
//   struct NAME            its constants of the wood
//     description()        what rooms outside know of it (law.hpp): name, keys, rules for its constants, yield surface
//     Hardening            its numbers in a strand: start(), the history variable as formed; holds(), whether the
//     strand
//                          is of this law; visit(), the numbers as files keep them: name, unit, meaning
//     hardening(material)  those of a strand of this wood
//     Rule, rule()         what the return map needs of the hardening
//     kNeedsVolume         whether From reads Flow::volume and dvolume
//     locked_in()          the history variable where wood stiffens under stress and elastic strain becomes plastic:
//                          from what it was, the volume ratio J and what is left of ln J_e
//     radius<Ops>()        radius of the surface as a function of the history variable alone, in the same bits wherever
//                          it is computed, so that a restart finds it again
//     From<Ops>            how the surface hardens in one step from the history variable and the radius before it:
//                          at(flow), and before(trial), where `trial` is the flow at mu = 0
//
// The header is plain data and arithmetic, for the engine's kernels include it (return_map.hpp); the rest is the source
// file's. Which law holds is a property of the wood as a kind of strand uses it (Material::law).
#pragma once

#include <type_traits>

#include "strandlab/wood/laws/crushing.hpp"
#include "strandlab/wood/laws/hill.hpp"

// LAW(type, member): the law's struct, and its name as a member of structs that have one for each. The first one is
// that of a strand to which no other applies.
#define STRANDLAB_LAWS(LAW) \
  LAW(Hill, hill)           \
  LAW(Crushing, crushing)

namespace strandlab::wood {

enum class Law {
#define LAW(type, member) k##type,
  STRANDLAB_LAWS(LAW)
#undef LAW
};

struct LawConstants {
#define LAW(type, member) type member;
  STRANDLAB_LAWS(LAW)
#undef LAW
};

struct LawHardening {
#define LAW(type, member) type::Hardening member;
  STRANDLAB_LAWS(LAW)
#undef LAW
};

struct LawRules {
#define LAW(type, member) type::Rule member;
  STRANDLAB_LAWS(LAW)
#undef LAW
};

// What a law has in one of these structs.
template <class L, class All>
[[gnu::always_inline]] inline auto& part_of(All& all) {
#define LAW(type, member) \
  if constexpr (std::is_same_v<L, type>) return all.member;
  STRANDLAB_LAWS(LAW)
#undef LAW
}

// Calls visit.operator()<L>() for the law L, and returns what it returns.
template <class Visit>
[[gnu::always_inline]] inline decltype(auto) with_law(Law law, const Visit& visit) {
  switch (law) {
#define LAW(type, member) \
  case Law::k##type:      \
    return visit.template operator()<type>();
    STRANDLAB_LAWS(LAW)
#undef LAW
  }
  __builtin_unreachable();
}

// Calls visit.operator()<L>() for each law, in the order of the list.
template <class Visit>
void for_each_law(const Visit& visit) {
#define LAW(type, member) visit.template operator()<type>();
  STRANDLAB_LAWS(LAW)
#undef LAW
}

template <class L>
inline constexpr Law kLaw = [] {
#define LAW(type, member) \
  if constexpr (std::is_same_v<L, type>) return Law::k##type;
  STRANDLAB_LAWS(LAW)
#undef LAW
}();

}  // namespace strandlab::wood
