// Appends to a list of pixels (frame.h), a storage buffer of uint.
#define APPEND(list, item)                                                     \
  {                                                                            \
    uint place = atomicAdd(list[kListCountAt], 1u);                            \
    list[kListFirstAt + place] = item;                                         \
    if (place % kListGroup == 0u && place / kListGroup < kListMostGroups) {    \
      atomicAdd(list[0], 1u);                                                  \
    }                                                                          \
  }
