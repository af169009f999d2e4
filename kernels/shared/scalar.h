// `real` as one scalar: an item an element.
typedef scalar real;
typedef int mask;
