// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <type_traits>
#include <utility>

// What scripts/mutate puts into a copy of a source: every place where it could be wrong gets
// numbers, and the number in TRUEFLANK_MUTANT is wrong. One build serves for all of them.
// TRUEFLANK_MUTANTS_SEEN: a file that gets the numbers of places that were passed, one a line;
// negative where an operator is of no number and stays as it is. After a comparison of real numbers
// stands "real", and "equal" where they were equal once: only there does `<=` differ from `<`.
namespace mutation {

inline int wanted() {
  static const int number = [] {
    const char* text = std::getenv("TRUEFLANK_MUTANT");
    return text != nullptr ? std::atoi(text) : 0;
  }();
  return number;
}

/// What was met at the places passed, written at the end.
class Seen {
 public:
  enum What : unsigned char { kPassed = 1, kNoNumber = 2, kReal = 4, kEqual = 8 };
  static void pass(int number, unsigned char what = kPassed) {
    static const char* const file = std::getenv("TRUEFLANK_MUTANTS_SEEN");
    if (file == nullptr) return;
    static Seen seen(file);
    const auto place = static_cast<std::size_t>(number);
    if (place < kPlaces && (places_[place].load(std::memory_order_relaxed) & what) != what)
      places_[place].fetch_or(what, std::memory_order_relaxed);
  }

 private:
  explicit Seen(const char* file) : file_(file) {}
  ~Seen() {
    std::FILE* out = std::fopen(file_, "a");
    if (out == nullptr) return;
    for (std::size_t i = 0; i < kPlaces; ++i) {
      const unsigned what = places_[i].load();
      if ((what & kNoNumber) != 0U) std::fprintf(out, "-%zu\n", i);
      if ((what & kPassed) != 0U)
        std::fprintf(out, "%zu%s%s\n", i, (what & kReal) != 0U ? " real" : "",
                     (what & kEqual) != 0U ? " equal" : "");
    }
    std::fclose(out);
  }
  static constexpr std::size_t kPlaces = 100000;
  static inline std::array<std::atomic<unsigned char>, kPlaces> places_{};
  const char* file_;
};

constexpr bool on(int number) {
  if (std::is_constant_evaluated()) return false;
  Seen::pass(number);
  return wanted() == number;
}

constexpr void without_number(int number) {
  if (!std::is_constant_evaluated()) Seen::pass(number, Seen::kNoNumber);
}

template <class A, class B>
constexpr void compared(int number, const A& a, const B& b) {
  if constexpr (std::is_floating_point_v<A> || std::is_floating_point_v<B>)
    if (!std::is_constant_evaluated())
      Seen::pass(number,
                 static_cast<unsigned char>(a == b ? Seen::kReal | Seen::kEqual : Seen::kReal));
}

// An operator stands twice with its place between: `a + place + b` binds as `a + b` does.
#define TRUEFLANK_MUTATED(name, op, first, second)                                              \
  struct name {                                                                                 \
    int number;                                                                                 \
  };                                                                                            \
  template <class A>                                                                            \
  struct name##Left {                                                                           \
    A&& a;                                                                                      \
    int number;                                                                                 \
  };                                                                                            \
  template <class A>                                                                            \
  constexpr name##Left<A> operator op(A&& a, name place) {                                      \
    return {std::forward<A>(a), place.number};                                                  \
  }                                                                                             \
  template <class A, class B>                                                                   \
  constexpr decltype(auto) operator op(name##Left<A>&& left, B&& b) {                           \
    using Plain = std::remove_cvref_t<decltype(std::forward<A>(left.a) op std::forward<B>(b))>; \
    if constexpr (std::is_arithmetic_v<Plain>) {                                                \
      if constexpr (std::is_same_v<Plain, bool>) compared(left.number, left.a, b);              \
      if (on(left.number)) return static_cast<Plain>(left.a first b);                           \
      if (on(left.number + 1)) return static_cast<Plain>(left.a second b);                      \
      return static_cast<Plain>(left.a op b);                                                   \
    } else {                                                                                    \
      without_number(left.number);                                                              \
      return std::forward<A>(left.a) op std::forward<B>(b);                                     \
    }                                                                                           \
  }
TRUEFLANK_MUTATED(Less, <, <=, >)
TRUEFLANK_MUTATED(More, >, >=, <)
TRUEFLANK_MUTATED(NotMore, <=, <, >)
TRUEFLANK_MUTATED(NotLess, >=, >, <)
TRUEFLANK_MUTATED(Equal, ==, !=, !=)
TRUEFLANK_MUTATED(Unequal, !=, ==, ==)
TRUEFLANK_MUTATED(Plus, +, -, -)
TRUEFLANK_MUTATED(Minus, -, +, +)
TRUEFLANK_MUTATED(Times, *, +, +)
TRUEFLANK_MUTATED(Over, /, *, *)
#undef TRUEFLANK_MUTATED

#define TRUEFLANK_MUTATED(name, op, other)                          \
  struct name {                                                     \
    int number;                                                     \
  };                                                                \
  template <class B>                                                \
  struct name##Right {                                              \
    B&& b;                                                          \
    int number;                                                     \
  };                                                                \
  template <class B>                                                \
  constexpr name##Right<B> operator op(name place, B&& b) {         \
    return {std::forward<B>(b), place.number};                      \
  }                                                                 \
  template <class A, class B>                                       \
  constexpr A& operator op(A& a, name##Right<B>&& right) {          \
    if constexpr (std::is_arithmetic_v<A>) {                        \
      if (on(right.number)) return a other static_cast<A>(right.b); \
    } else {                                                        \
      without_number(right.number);                                 \
    }                                                               \
    a op std::forward<B>(right.b);                                  \
    return a;                                                       \
  }
TRUEFLANK_MUTATED(Add, +=, -=)
TRUEFLANK_MUTATED(Subtract, -=, +=)
#undef TRUEFLANK_MUTATED

struct Flip {
  int number;
};
constexpr bool operator^(Flip flip, bool value) { return on(flip.number) ? !value : value; }

#define TRUEFLANK_MUTATED(name, function, other)                  \
  struct name {                                                   \
    int number;                                                   \
    template <class T>                                            \
    constexpr T operator()(const T& a, const T& b) const {        \
      return on(number) ? std::other(a, b) : std::function(a, b); \
    }                                                             \
    template <class T>                                            \
    constexpr T operator()(std::initializer_list<T> all) const {  \
      return on(number) ? std::other(all) : std::function(all);   \
    }                                                             \
  };
TRUEFLANK_MUTATED(Min, min, max)
TRUEFLANK_MUTATED(Max, max, min)
#undef TRUEFLANK_MUTATED

}  // namespace mutation
