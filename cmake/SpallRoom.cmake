# A room is one library, linked only to the rooms that it may use: the linker keeps includes running one way.
#   spall_room(<name> SOURCES ... ROOMS ... LIBRARIES ...)
function(spall_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;ROOMS;LIBRARIES" ${ARGN})
  add_library(spall_${name} STATIC ${ROOM_SOURCES})
  add_library(spall::${name} ALIAS spall_${name})
  set_target_properties(spall_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(spall_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                             $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/spall>)
  list(TRANSFORM ROOM_ROOMS PREPEND spall_)
  target_link_libraries(spall_${name} PUBLIC ${ROOM_ROOMS} ${ROOM_LIBRARIES})
  spall_flags(spall_${name})
  set_property(GLOBAL APPEND PROPERTY SPALL_ROOMS spall_${name})
endfunction()

# The flags that every target of the project shares. No -ffast-math: it would void the checks for NaN.
function(spall_flags target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wold-style-cast -Wnon-virtual-dtor
                         -Woverloaded-virtual -fno-math-errno)
  if(SPALL_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(SPALL_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=${SPALL_SANITIZE} -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${SPALL_SANITIZE})
  endif()
endfunction()
