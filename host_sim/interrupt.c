/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700 /* sigaction, SIGXFSZ */
#include "interrupt.h"

#include <signal.h>
#include <string.h>

static volatile sig_atomic_t arrived = 0;

static void note(int signal_number) {
    arrived = signal_number;
}

void interrupt_watch(void) {
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = note;
    action.sa_flags = (int)(SA_RESTART | (int)SA_RESETHAND);
    (void)sigemptyset(&action.sa_mask);
    for (size_t index = 0; index < sizeof signals / sizeof signals[0]; index++) {
        struct sigaction before;
        if (sigaction(signals[index], NULL, &before) == 0 && before.sa_handler != SIG_IGN) {
            (void)sigaction(signals[index], &action, NULL);
        }
    }
    (void)signal(SIGPIPE, SIG_IGN);
    (void)signal(SIGXFSZ, SIG_IGN);
}

int interrupt_signal(void) {
    return arrived;
}

void interrupt_obey(void) {
    if (arrived != 0) {
        (void)signal(arrived, SIG_DFL);
        (void)raise(arrived);
    }
}
