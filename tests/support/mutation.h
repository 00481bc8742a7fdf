// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <set>
#include <type_traits>
#include <utility>

// What scripts/mutate puts into a copy of a source: every place where it could be wrong gets
// numbers, and the number in TRUEFLANK_MUTANT is wrong. One build serves for all of them.
// TRUEFLANK_MUTANTS_SEEN: a file that gets the numbers of places that were passed, one a line;
// negative where an operator is of no number and stays as it is.
namespace mutation {

inline int wanted() {
  static const int number = [] {
    const char* text = std::getenv("TRUEFLANK_MUTANT");
    return text != nullptr ? std::atoi(text) : 0;
  }();
  return number;
}

/// The places passed, written at the end.
class Seen {
 public:
  static void pass(int number) {
    static const char* const file = std::getenv("TRUEFLANK_MUTANTS_SEEN");
    if (file == nullptr) return;
    static Seen seen(file);
    seen.numbers_.insert(number);
  }

 private:
  explicit Seen(const char* file) : file_(file) {}
  ~Seen() {
    if (std::FILE* out = std::fopen(file_, "a")) {
      for (const int number : numbers_) std::fprintf(out, "%d\n", number);
      std::fclose(out);
    }
  }
  const char* file_;
  std::set<int> numbers_;
};

constexpr bool on(int number) {
  if (std::is_constant_evaluated()) return false;
  Seen::pass(number);
  return wanted() == number;
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
      if (on(left.number)) return static_cast<Plain>(left.a first b);                           \
      if (on(left.number + 1)) return static_cast<Plain>(left.a second b);                      \
      return static_cast<Plain>(left.a op b);                                                   \
    } else {                                                                                    \
      if (!std::is_constant_evaluated()) Seen::pass(-left.number);                              \
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
    if constexpr (std::is_arithmetic_v<A>)                          \
      if (on(right.number)) return a other static_cast<A>(right.b); \
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
