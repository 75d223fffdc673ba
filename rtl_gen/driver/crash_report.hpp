#pragma once
// Errors of epiline-hls itself: an unexpected exception, a fatal error of LLVM, a signal. All end the same way: one
// line that says so, and a folder with what is needed to see the error again.

#include <string>

namespace epiline::driver {

/// From now on such errors end the program with exit code 70. The folder is made beside other temporary files, and only
/// when it is needed.
void watch_for_crashes(int argc, char** argv);

/// In a process that was forked: its report has a folder of its own.
void crash_report_of_this_process();

/// What the folder will hold as source.cpp.
void keep_for_crash_report(std::string source);

/// Ends the program with the report. `what`: one line without a full stop.
[[noreturn]] void report_crash(const std::string& what);

/// For the tests: an error of the kind "exception", "fatal", "signal" or "stack".
void crash_on_purpose(const std::string& kind);

}  // namespace epiline::driver
