// Says in one line what is in a recording: FRAMES DECISIONS LAST_TIME_S TORN_BYTES whole|cut. Exit code 1 when it cannot be read.
#include <iostream>

#include "incognita/io/recording_file.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    const incognita::Recording recording = incognita::read_recording(argv[1]);
    std::cout << recording.frames.size() << ' ' << recording.decisions.size() << ' '
              << (recording.frames.empty() ? 0.0 : recording.frames.back().time_s) << ' ' << recording.torn_bytes << ' '
              << (recording.end ? "whole" : "cut") << '\n';
    return 0;
  } catch (const incognita::InputError& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
