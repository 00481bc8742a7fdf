// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>

namespace trueflank::test {

/// How many random trials a survey makes: the first `gate` of them in `make test`, all of them in `make campaign`.
/// The trials are the same ones: their seeds follow each other.
inline int survey_size(int gate, int all) { return std::getenv("TRUEFLANK_CAMPAIGN") != nullptr ? all : gate; }

}  // namespace trueflank::test
