// Four scalars in a register: what rows.h is written in.
typedef scalar4 Row;
