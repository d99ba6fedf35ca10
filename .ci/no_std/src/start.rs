//! How a program begins and ends without std and libc, on Linux and x86-64.

use crate::main;
use core::arch::{asm, global_asm};

// the kernel enters with an aligned stack, but a function expects the alignment before its caller's `call`
global_asm!(".globl _start", "_start:", "and rsp, -16", "call {main}", "ud2", main = sym main);

pub fn exit(code: u32) -> ! {
    // SAFETY: system call 60 is exit, which takes a code and does not return
    unsafe { asm!("syscall", in("rax") 60, in("rdi") code, options(noreturn)) }
}

// the compiler may call these three on any target; without libc, the program must define them
global_asm!(
    ".globl memcpy",
    "memcpy:",
    "mov rax, rdi",
    "mov rcx, rdx",
    "rep movsb",
    "ret",
    ".globl memset",
    "memset:",
    "mov r8, rdi",
    "mov eax, esi",
    "mov rcx, rdx",
    "rep stosb",
    "mov rax, r8",
    "ret",
    // backwards if the source is before the target
    ".globl memmove",
    "memmove:",
    "mov rax, rdi",
    "mov rcx, rdx",
    "cmp rsi, rdi",
    "jae 2f",
    "lea rsi, [rsi + rdx - 1]",
    "lea rdi, [rdi + rdx - 1]",
    "std",
    "2:",
    "rep movsb",
    "cld",
    "ret",
);

#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    exit(255)
}
