#!/usr/bin/env perl
# Plants faults into copies of source files, each behind a switch: planted(n) is true where the environment says
# PLANTED_FAULT=n, so that one build holds all of them.  A file is written only where it changes.
# Usage: plant_faults.pl LIST SOURCES COPY   (the list's form is told at its head)
# Prints a line a fault: its number, test program, filter and name, with tabs between.
use strict;
use warnings;

my ($list, $sources, $copy) = @ARGV;
my (@faults, %edits, $file);

open my $lines, '<', $list or die "$list: $!\n";
while (<$lines>) {
  chomp;
  next if /^\s*(#|$)/;
  if (/^= (.+)/) { push @faults, {name => $1} }
  elsif (/^  in (\S+): (.*)/) { site($1, $2) }
  elsif (/^  is (.+)/) { $faults[-1]{site}{wrong} = $1 }
  elsif (/^  by (\S+) (\S+)/) { @{$faults[-1]}{qw(tests filter)} = ($1, $2) }
  else { die "$list:$.: no fault's line\n" }
}

sub text_of {
  my ($path) = @_;
  open my $in, '<', $path or return '';
  local $/;
  return scalar <$in>;
}

# Where the file says so, and once: there all between [[ and ]] is what the fault changes.
sub site {
  my ($path, $says) = @_;
  my ($before, $right, $after) = $says =~ /^(.*?)\[\[(.*)\]\](.*)$/ or die "$list:$.: no [[ ]]\n";
  my $text = text_of("$sources/$path");
  my @found;
  push @found, $-[0] while $text =~ /\Q$before$right$after\E/g;
  if (@found != 1) {
    $faults[-1]{lost} = "$path says " . scalar(@found) . " times, not once: $before$right$after";
    $faults[-1]{site} = {};
    return;
  }
  my $site = {fault => scalar(@faults), from => $found[0] + length $before, right => $right};
  push @{$edits{$path}}, $site;
  $faults[-1]{site} = $site;
}

# A statement, with its semicolon, or an expression.
sub switched {
  my ($right, $site) = @_;
  my $on = "planted($site->{fault})";
  return $right =~ /;$/ ? "if (!$on) { $right } else { $site->{wrong} }" : "(!$on ? ($right) : ($site->{wrong}))";
}

sub write_to {
  my ($path, $text) = @_;
  return if text_of($path) eq $text;
  open my $out, '>', $path or die "$path: $!\n";
  print $out $text or die "$path: $!\n";
  close $out or die "$path: $!\n";  # what is buffered fails here
}

write_to("$copy/planted_fault.h", <<'HEADER');
#pragma once
#include <cstdlib>
inline bool planted(int fault) {
  static const char* const asked = std::getenv("PLANTED_FAULT");
  static const int number = asked != nullptr ? std::atoi(asked) : 0;
  return fault == number;
}
HEADER
for my $path (sort keys %edits) {
  my $text = text_of("$sources/$path");
  my %at;
  push @{$at{"$_->{from} " . length $_->{right}}}, $_ for @{$edits{$path}};
  my $end = length $text;
  for my $place (sort { (split ' ', $b)[0] <=> (split ' ', $a)[0] } keys %at) {
    my ($from, $length) = split ' ', $place;
    die "$path: faults overlap at: $at{$place}[0]{right}\n" if $from + $length > $end;
    my $now = $at{$place}[0]{right};
    $now = switched($now, $_) for @{$at{$place}};
    substr($text, $from, $length) = $now;
    $end = $from;
  }
  write_to("$copy/$path", "#include \"planted_fault.h\"\n$text");
}
for my $n (1 .. @faults) {
  my $fault = $faults[$n - 1];
  print STDERR "NOT PLANTED  $fault->{name}: $fault->{lost}\n" if $fault->{lost};
  print join("\t", $fault->{lost} ? 0 : $n, @{$fault}{qw(tests filter name)}), "\n";
}
