// What:   output files that are whole or not there at all.
// Cost:   writing.
#pragma once

#include <string>

namespace inkgrid::cli {

// A signal that ends the program removes the temporary file of the moment first.
void remove_temporary_on_signals();

// Throws Error{file} where write_file would fail for a reason that is known beforehand.  "-" is standard output.
void check_writable(const std::string& path);

// The same for a directory that is made, or files made in it.
void check_writable_directory(const std::string& path);

// Writes a temporary file in the same directory and renames it.  Throws Error{file}.
void write_file(const std::string& path, const std::string& text);

}  // namespace inkgrid::cli
