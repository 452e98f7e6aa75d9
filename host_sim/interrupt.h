/* SPDX-License-Identifier: MIT */
/*
 * interrupt.h - Ctrl-C, kill and a closed terminal end a run between two rows, so that it can take
 * its temporary files with it. A second signal of the same kind ends it at once.
 */
#ifndef HOST_SIM_INTERRUPT_H
#define HOST_SIM_INTERRUPT_H

/** From here on the signals are noted instead of obeyed; one that was ignored stays ignored. A
 * reader that goes away and a limit on the size of files make a write fail instead of ending the
 * program. */
void interrupt_watch(void);

/** The signal that came, 0 when none has. */
int interrupt_signal(void);

/** Ends the program by the signal that came, as its caller expects; returns when none has. */
void interrupt_obey(void);

#endif
