# A package with a Debian revision says in a changelog of its own who made it, and when (SOURCE_DATE_EPOCH, or now).
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(file ${CPACK_TEMPORARY_DIRECTORY}${CPACK_PACKAGING_INSTALL_PREFIX}/share/doc/zstep/changelog.Debian)
file(WRITE ${file} "zstep (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium

  * Package of this version; what is new in it is told in changelog.gz.

 -- ${CPACK_PACKAGE_CONTACT}  ${now}
")
execute_process(COMMAND gzip -9nf ${file} COMMAND_ERROR_IS_FATAL ANY)
