# What a desktop needs to know of the programs, and the packages: `cmake --install build/release`, or `cpack` in there.
include(GNUInstallDirs)

# The program and its manual page, made of its --help-all.
function(oriel_install program component)
  set(page ${CMAKE_BINARY_DIR}/man/${program}.1)
  install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ${component})
  install(CODE "execute_process(COMMAND \"${CMAKE_COMMAND}\" \"-DPROGRAM=$<TARGET_FILE:${program}>\" -DNAME=${program}
                  \"-DOUTPUT=${page}\" -P \"${CMAKE_CURRENT_FUNCTION_LIST_DIR}/man.cmake\" COMMAND_ERROR_IS_FATAL ANY)"
          COMPONENT ${component})
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT ${component})
endfunction()

# What bash completes, made by the program.
function(oriel_install_completion program component)
  set(script ${CMAKE_BINARY_DIR}/completion/${program})
  install(CODE "file(MAKE_DIRECTORY \"${CMAKE_BINARY_DIR}/completion\")
                execute_process(COMMAND \"$<TARGET_FILE:${program}>\" --completion bash
                  OUTPUT_FILE \"${script}\" COMMAND_ERROR_IS_FATAL ANY)"
          COMPONENT ${component})
  install(FILES ${script} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT ${component})
endfunction()

oriel_install(oriel-play player)
oriel_install_completion(oriel-play player)
install(FILES ${CMAKE_CURRENT_LIST_DIR}/oriel-play.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT player)
install(FILES ${CMAKE_CURRENT_LIST_DIR}/oriel.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages COMPONENT player)
oriel_install(oriel-bake tools)
oriel_install_completion(oriel-bake tools)
oriel_install(oriel-import tools)
oriel_install_completion(oriel-import tools)
oriel_install(oriel-preview tools)
oriel_install_completion(oriel-preview tools)
oriel_install(oriel-inspect tools)
oriel_install_completion(oriel-inspect tools)

set(CPACK_PACKAGE_NAME oriel)
set(CPACK_PACKAGE_VENDOR Oriel)
set(CPACK_PACKAGE_CONTACT "The Oriel developers <maintainers@oriel.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Baked light for walkthroughs")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL player tools)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PLAYER_PACKAGE_NAME oriel-play)
# epoxy opens these by name, which no link line tells.
set(CPACK_DEBIAN_PLAYER_PACKAGE_DEPENDS "libegl1, libgl1")
set(CPACK_DEBIAN_PLAYER_PACKAGE_RECOMMENDS libgl1-mesa-dri)
set(CPACK_DEBIAN_PLAYER_PACKAGE_SUGGESTS ffmpeg)
set(CPACK_COMPONENT_PLAYER_DESCRIPTION "Walks through scenes whose light oriel-bake has baked")
set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME oriel-tools)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SUGGESTS oriel-play)
set(CPACK_COMPONENT_TOOLS_DESCRIPTION "Bakes light into packs, and tells what they hold")
include(CPack)
