/* SPDX-License-Identifier: MIT */
/*
 * server_counts.h - called before and after each step of server.c, where a processor counts by itself.
 */
#ifndef TARGET_SERVER_COUNTS_H
#define TARGET_SERVER_COUNTS_H

void server_before_step(void);
void server_after_step(void);

#endif
