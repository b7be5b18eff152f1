// Mutations of the fuzz target by lines and values, from cases that are known to parse.
#pragma once
#include <string_view>

/// Most of the mutations begin with one of the last cases that parsed: few changes lead from one to the next.
void remember_sound_case(std::string_view text);
