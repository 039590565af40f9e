# Copies a source file without its record calls, into the namespace zstep::stripped:
#     cmake -DFROM=… -DTO=… -P strip_records.cmake
# What is left is the algorithm as it would be written if nothing were ever recorded; tests/bench compares the two.
file(READ ${FROM} text)
string(REGEX REPLACE "\n[ \t]*record\\([^\n]*" "" text "${text}")
string(REPLACE "namespace zstep::" "namespace zstep::stripped::" text "${text}")
if(text MATCHES "[^a-z_]record\\(")
  message(FATAL_ERROR "${FROM} has a record call that is not a line of its own")
endif()
file(WRITE ${TO} "${text}")
