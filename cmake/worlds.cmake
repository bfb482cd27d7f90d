# SINEW_WORLDS -> `worlds_left_out`, a word for each type of world that is not in the list (sinew/world/world_types.h).
set(worlds_left_out)
foreach(type IN ITEMS 2-float 2-double 3-float 3-double)
    if(NOT type IN_LIST SINEW_WORLDS)
        string(REPLACE - _ word ${type})
        string(TOUPPER SINEW_NO_WORLD_${word} word)
        list(APPEND worlds_left_out ${word})
    endif()
endforeach()
