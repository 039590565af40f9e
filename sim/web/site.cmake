# Puts the page's own files beside the program, and into the worker what they are, and makes of
# them the page that `zstep publish` puts a run into: -DPAGE=, -DICON=, -DSITE=, -DWHOLE=, -DTRACE_VERSION=.
file(GLOB page ${PAGE}/*)
file(COPY ${page} ${ICON} DESTINATION ${SITE})
set(files film.js index.html page.css page.js zstep.data zstep.js zstep.rest.wasm zstep.svg zstep.wasm zstep.webmanifest)
set(all "")
foreach(name IN LISTS files)
  file(SHA256 ${SITE}/${name} hash)
  string(APPEND all ${hash})
endforeach()
string(SHA256 hash "${all}")
string(SUBSTRING ${hash} 0 16 VERSION)
list(JOIN files "', '" FILES)
set(FILES "['./', '${FILES}']")
configure_file(${PAGE}/worker.js ${SITE}/worker.js @ONLY)

execute_process(COMMAND python3 ${CMAKE_CURRENT_LIST_DIR}/one_page.py ${SITE} ${WHOLE} ${SITE}/publish.html ${TRACE_VERSION}
  COMMAND_ERROR_IS_FATAL ANY)
