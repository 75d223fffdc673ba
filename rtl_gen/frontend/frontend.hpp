#pragma once
// The frontend's front door: a C++ source and the name of a function in it become a dataflow graph.

#include "frontend/build_graph.hpp"
#include "frontend/compile.hpp"
#include "frontend/join_processes.hpp"
#include "frontend/lower.hpp"
#include "frontend/processes.hpp"
#include "frontend/source.hpp"
