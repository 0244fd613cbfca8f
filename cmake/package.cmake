# SPDX-License-Identifier: BSD-3-Clause
# What is shipped: hardened; as a prefix (cmake --install) or as two Debian packages (cpack): fulmar flies, fulmar-dev builds plugins.
set(shipped fulmar_tables fulmar_records fulmar_tick fulmar_core fulmar_live_words fulmar_inspect_words fulmar_chart fulmar_log_words fulmar_new_words fulmar_report fulmar_program fulmar_app fulmar fulmar-inspect fulmar-log fulmar-live fulmar-new fulmar-probe fulmar-child fulmar-fcu fulmar-ros2 fulmar_report_words fulmar-report fulmar_aero_words fulmar-aero fulmar-import fulmar_sim ${shipped_plugins} python fulmar_module)
foreach(target IN LISTS shipped)
  if(TARGET ${target})
    fulmar_harden(${target})
  endif()
endforeach()

# Hardware: the unit that flies a mission, its account, the name of the serial port. Literal lib/: where systemd and udev look.
install(FILES cmake/systemd/fulmar@.service DESTINATION lib/systemd/system)
install(FILES cmake/systemd/fulmar.conf DESTINATION lib/sysusers.d)
install(FILES cmake/systemd/70-fulmar.rules DESTINATION lib/udev/rules.d)

set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # the target `flight` is enough to install and to pack
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME fulmar)
set(CPACK_PACKAGE_VENDOR Fulmar)
set(CPACK_PACKAGE_CONTACT "Fulmar authors <fulmar@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Fixed-wing autopilot framework for research")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime dev)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME fulmar)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS python3-numpy)  # import fulmar_sim
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/systemd/postinst)
set(CPACK_DEBIAN_DEV_PACKAGE_NAME fulmar-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
    "fulmar (= ${PROJECT_VERSION}), libeigen3-dev (>= 3.4), doctest-dev, cmake (>= 3.22), ninja-build, g++ | clang")
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "Fixed-wing autopilot framework for research: host, plugins, missions")
set(CPACK_COMPONENT_DEV_DESCRIPTION "Fixed-wing autopilot framework for research: SDK and templates for plugins")
include(CPack)
