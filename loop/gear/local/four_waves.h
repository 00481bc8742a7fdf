// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

#include "trueflank/base/widest_registers.h"

// Waves of many lengths at four values at once: what many Fourier sums are made of.
namespace trueflank::loop {

/// The first wave at each of four values, and what turns it into the next one, and so on.
struct FourWaves {
  std::array<double, 4> real{}, imaginary{}, turn_real{}, turn_imaginary{};
};

/// Four rows of four values, written as four columns that stand `apart`.
TRUEFLANK_ALWAYS_INLINE inline void write_columns(const FourDoubles (&rows)[4], double* to,
                                                  std::size_t apart) {
  const FourDoubles even_first = __builtin_shufflevector(rows[0], rows[1], 0, 4, 2, 6),
                    odd_first = __builtin_shufflevector(rows[0], rows[1], 1, 5, 3, 7),
                    even_last = __builtin_shufflevector(rows[2], rows[3], 0, 4, 2, 6),
                    odd_last = __builtin_shufflevector(rows[2], rows[3], 1, 5, 3, 7);
  store(__builtin_shufflevector(even_first, even_last, 0, 1, 4, 5), to);
  store(__builtin_shufflevector(odd_first, odd_last, 0, 1, 4, 5), to + apart);
  store(__builtin_shufflevector(even_first, even_last, 2, 3, 6, 7), to + 2 * apart);
  store(__builtin_shufflevector(odd_first, odd_last, 2, 3, 6, 7), to + 3 * apart);
}

/// Writes `count` waves (a multiple of four) of each value beside each other: those of the next
/// value stand `apart` places on. For code in widest registers; the digits are those of one value
/// after the other.
TRUEFLANK_ALWAYS_INLINE inline void write_waves(const FourWaves& waves, std::size_t count,
                                                double* real, double* imaginary,
                                                std::size_t apart) {
  FourDoubles re, im, turn_re, turn_im;
  load(re, waves.real.data());
  load(im, waves.imaginary.data());
  load(turn_re, waves.turn_real.data());
  load(turn_im, waves.turn_imaginary.data());
  for (std::size_t k = 0; k < count; k += 4) {
    FourDoubles of_real[4], of_imaginary[4];
    for (std::size_t i = 0; i < 4; ++i) {
      of_real[i] = re;
      of_imaginary[i] = im;
      const FourDoubles next = re * turn_re - im * turn_im;
      im = re * turn_im + im * turn_re;
      re = next;
    }
    write_columns(of_real, real + k, apart);
    write_columns(of_imaginary, imaginary + k, apart);
  }
}

}  // namespace trueflank::loop
