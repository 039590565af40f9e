# The man page, from what the program says of itself: its commands, and each one's options and examples. PROGRAM, TO.
cmake_policy(VERSION 3.24)

# A hyphen stays one, a backslash too, and no line is taken for a request.
function(add_help title)
  execute_process(COMMAND ${PROGRAM} ${ARGN} --help OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\\" "\\e" said "${said}")
  string(REPLACE "-" "\\-" said "${title}\n.nf\n${said}")
  string(REGEX REPLACE "\n([^.]|\\.[^nS])" "\n\\\\&\\1" said "${said}")
  file(APPEND ${TO} "${said}\n.fi\n")
endfunction()

file(WRITE ${TO} ".TH ZSTEP 1\n.SH NAME\nzstep \\- step\\-through simulator of visible\\-surface methods\n"
  ".SH SYNOPSIS\n.B zstep\n.RI [ command ]\n")
add_help(".SH DESCRIPTION")
execute_process(COMMAND ${PROGRAM} --help OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "^.*\nSubcommands:\n" "\n" said "${said}")
string(REGEX REPLACE "\n\n.*$" "" said "${said}")
string(REGEX MATCHALL "\n  [a-z-]+" commands "${said}")
foreach(command IN LISTS commands)
  string(STRIP "${command}" command)
  string(TOUPPER ${command} title)
  add_help(".SH ZSTEP ${title}" ${command})
endforeach()
