# BUILD, TO, CPACK, DPKG_DEB, LINTIAN (may be none).
file(REMOVE_RECURSE ${TO})
execute_process(COMMAND ${CPACK} --config ${BUILD}/CPackConfig.cmake -B ${TO}
  -D "CPACK_PACKAGE_CONTACT=A Maintainer <maintainer@debian.org>" COMMAND_ERROR_IS_FATAL ANY)
file(GLOB package ${TO}/zstep_*.deb)
execute_process(COMMAND ${DPKG_DEB} --contents ${package} OUTPUT_VARIABLE contents COMMAND_ERROR_IS_FATAL ANY)
foreach(file
    bin/zstep share/zstep/lessons/4-z-buffer.md share/zstep/lessons/scenes/abc-def.toml
    share/applications/zstep.desktop share/applications/zstep-view.desktop share/mime/packages/zstep.xml
    share/icons/hicolor/scalable/apps/zstep.svg share/bash-completion/completions/zstep share/man/man1/zstep.1.gz
    share/doc/zstep/copyright share/doc/zstep/changelog.gz
    share/doc/zstep/changelog.Debian.gz)
  string(FIND "${contents}" " ./usr/${file}\n" at)
  if(at EQUAL -1)
    message(SEND_ERROR "the package lacks usr/${file}")
  endif()
endforeach()

execute_process(COMMAND ${DPKG_DEB} --extract ${package} ${TO}/there COMMAND_ERROR_IS_FATAL ANY)
# The program finds its lessons where the package puts them, and every command has a section of the man page.
execute_process(COMMAND ${TO}/there/usr/bin/zstep list lessons OUTPUT_VARIABLE lessons COMMAND_ERROR_IS_FATAL ANY)
if(NOT lessons MATCHES "z-buffer")
  message(SEND_ERROR "the installed program has no lessons")
endif()
execute_process(COMMAND gzip -dc ${TO}/there/usr/share/man/man1/zstep.1.gz OUTPUT_VARIABLE page COMMAND_ERROR_IS_FATAL ANY)
foreach(part "SH ZSTEP VIEW" "SH ZSTEP COMPARE" "\\-\\-screenshot" "\\-\\-describe")
  string(FIND "${page}" "${part}" at)
  if(at EQUAL -1)
    message(SEND_ERROR "the man page lacks ${part}")
  endif()
endforeach()

if(LINTIAN)
  execute_process(COMMAND ${LINTIAN} --allow-root --fail-on error ${package} RESULT_VARIABLE failed)
  if(failed)
    message(SEND_ERROR "lintian finds errors in the package")
  endif()
endif()
